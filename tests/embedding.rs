//! The examples draw what they say.

#![allow(clippy::print_stdout, missing_docs, reason = "the examples are programs")]

#[path = "../examples/deferred/main.rs"]
mod deferred;
#[path = "../examples/renderer.rs"]
mod renderer;

/// Mean of red, green and blue, in code values, over `side`×`side` pixels around a place.
fn mean(picture: &[u8], width: usize, [x, y]: [usize; 2], side: usize) -> f64 {
    let rows = picture.chunks_exact(4 * width).skip(y - side / 2).take(side);
    let pixels = rows.flat_map(|row| row.chunks_exact(4).skip(x - side / 2).take(side));
    pixels.flat_map(|pixel| &pixel[..3]).map(|value| f64::from(*value)).sum::<f64>()
        / (3 * side * side) as f64
}

#[test]
fn a_foreign_renderer_gets_light_under_its_surfaces() {
    let plain = deferred::draw(false).expect("a device");
    let soft = deferred::draw(true).expect("a device");
    let width = 480;
    let at = |picture: &[u8], place| mean(picture, width, place, 5);
    // Plaster is no material of the kernel, nor is the wall: neither changes by a bit.
    let right = |picture: &[u8]| -> Vec<u8> {
        picture.chunks_exact(4 * width).flat_map(|row| row[4 * 310..].to_vec()).collect()
    };
    assert!(right(&plain) == right(&soft), "plaster and wall stay as they were");
    assert!(at(&plain, [333, 135]) > 10.0, "there is something to see of the plaster");
    // Light reaches what lies in the shadow of jade and marble, and comes from what lies beside it.
    let changes = |centre: usize| {
        let ball = |picture: &[u8]| -> Vec<f64> {
            (centre - 60..centre + 35).map(|x| at(picture, [x, 135])).collect()
        };
        let (plain, soft) = (ball(&plain), ball(&soft));
        let rises = plain.iter().zip(&soft).map(|(a, b)| b - a).fold(0.0, f64::max);
        let falls = plain.iter().zip(&soft).map(|(a, b)| a - b).fold(0.0, f64::max);
        (rises, falls)
    };
    for (name, centre) in [("jade", 97), ("marble", 240)] {
        let (rises, falls) = changes(centre);
        // Code values, of 255.
        assert!(rises > 4.0 && falls > 0.5, "{name}: rises by {rises}, falls by {falls}");
    }
}

#[test]
fn the_renderer_draws_jade_on_a_transparent_ground() {
    let picture = renderer::draw().expect("a device");
    let alpha = |x: usize, y: usize| picture[4 * (y * 320 + x) + 3];
    assert_eq!((alpha(160, 120), alpha(2, 2)), (255, 0));
    assert!(mean(&picture, 320, [140, 110], 9) > 30.0, "the ball is lit");
}
