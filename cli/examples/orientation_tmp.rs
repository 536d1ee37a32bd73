#![allow(clippy::all, warnings)]
use subsurface_cli::scene::{gltf, texture_orientation::*};
fn main() {
    let mut s = gltf::load(std::path::Path::new(&std::env::args().nth(1).unwrap()), |_| ()).unwrap().scene;
    for o in &s.objects { println!("{:?}", Evidence::of(o)); }
    s.flip_texture_v();
    for o in &s.objects { println!("flipped {:?}", Evidence::of(o)); }
}
