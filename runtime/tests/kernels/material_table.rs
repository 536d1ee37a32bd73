//! Where the parameter table lies makes no difference to the picture.

use crate::buffers::{Buffers, noise};
use crate::setup::{DEFAULT_STEM, Description, Diffuser, PATHS};
use subsurface_codegen::Estimator;
use subsurface_runtime::RowBinding;
use subsurface_runtime::SubsurfaceView;

/// Materials whose rows do not fit a uniform buffer: of 64 bytes each at least, 64 KiB in all.
const MANY: usize = 1024 + 1;

#[test]
fn a_table_in_a_storage_buffer_gives_the_picture_of_one_in_a_uniform_buffer() {
    let few = Description::pair(Estimator::ImportanceSampled { taps: 17 });
    let many = Description { stems: vec![DEFAULT_STEM; MANY], ..few.clone() };
    assert_eq!(few.compile().module().row_binding(), RowBinding::Uniform);
    assert_eq!(many.compile().module().row_binding(), RowBinding::Storage);
    let buffers = Buffers::plane([24, 16], 1).lit(|x, y| [0, 1, 2].map(|salt| noise(x, y, salt)));
    // The filter spans several pixels.
    let view = SubsurfaceView::orthographic_distances(0.3);
    for path in PATHS {
        let uniform = Diffuser::new(&few, path).diffuse(&view, &buffers);
        assert!(uniform != buffers.irradiance, "{path:?}: nothing is diffused");
        assert!(Diffuser::new(&many, path).diffuse(&view, &buffers) == uniform, "{path:?}");
    }
}
