//! What the subsurface pass reads.

use crate::bind_error::BindError;
use crate::extent::Extent;
use crate::input::{Holds, Input};
use crate::viewport::Viewport;
use crate::wgpu;

use super::descriptor::Settings;

/// What the pass reads. All views except the scale have one size.
///
/// Each is a view of two dimensions: of a texture, or of one layer of an array (`dimension: Some(D2)`,
/// `base_array_layer`, `array_layer_count: Some(1)`), such as one eye of two. Of a texture with several levels the view
/// shows the first one.
///
/// ```
/// # use subsurface_runtime::{SubsurfaceInputs, Viewport, wgpu};
/// # fn inputs<'a>(irradiance: &'a wgpu::TextureView, surface: &'a wgpu::TextureView, depth: &'a wgpu::TextureView) {
/// let left_eye = SubsurfaceInputs::new(irradiance, surface, depth).with_viewport(Viewport::new(0, 0, 640, 720));
/// # }
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct SubsurfaceInputs<'a> {
    /// Diffuse irradiance before the surface albedo, linear RGB: any float format with red, green and blue.
    pub irradiance: &'a wgpu::TextureView,
    /// Surface albedo (red, green, blue) and the material number as a float; a number below 0 marks pixels that do not
    /// scatter. A format that holds such numbers, `Rgba16Float` or `Rgba32Float`; any float format of three components
    /// and more where the numbers come from [`material_ids`](Self::material_ids).
    pub surface: &'a wgpu::TextureView,
    /// Depth: a depth texture (its depth aspect), or a float texture whose red is read;
    /// [`SubsurfaceView`](crate::SubsurfaceView) says what its values mean.
    pub depth: &'a wgpu::TextureView,
    /// Depth-stencil texture whose stencil marks translucent pixels with
    /// [`TRANSLUCENT_STENCIL`](crate::TRANSLUCENT_STENCIL): saves work on the fragment path. It is only read, and may
    /// be the texture whose depth aspect is `depth`. The compute path goes by the material number alone. By default
    /// none.
    pub depth_stencil: Option<&'a wgpu::TextureView>,
    /// Factor on the mean free path per pixel, in the first component, from 0.001 to 1000: any float format. A texture
    /// of one pixel holds for all; `None`, the default, is 1 everywhere.
    pub mean_free_path_scale: Option<&'a wgpu::TextureView>,
    /// Material numbers of their own, in the first component: `R8Uint`, `R16Uint` or `R32Uint`. A number that the kernel
    /// does not hold, such as the format's largest, marks pixels that do not scatter. The pass must be made with
    /// [`material_ids`](crate::SubsurfaceDescriptor::material_ids). By default the numbers are in `surface`.
    pub material_ids: Option<&'a wgpu::TextureView>,
    /// The part of the inputs and of the output to read and to write; by default all.
    pub viewport: Option<Viewport>,
}

impl<'a> SubsurfaceInputs<'a> {
    /// The inputs that every frame has.
    pub const fn new(
        irradiance: &'a wgpu::TextureView,
        surface: &'a wgpu::TextureView,
        depth: &'a wgpu::TextureView,
    ) -> Self {
        Self {
            irradiance,
            surface,
            depth,
            depth_stencil: None,
            mean_free_path_scale: None,
            material_ids: None,
            viewport: None,
        }
    }

    /// Sets [`depth_stencil`](Self::depth_stencil).
    #[must_use]
    pub const fn with_depth_stencil(mut self, depth_stencil: &'a wgpu::TextureView) -> Self {
        self.depth_stencil = Some(depth_stencil);
        self
    }

    /// Sets [`mean_free_path_scale`](Self::mean_free_path_scale).
    #[must_use]
    pub const fn with_mean_free_path_scale(mut self, scale: &'a wgpu::TextureView) -> Self {
        self.mean_free_path_scale = Some(scale);
        self
    }

    /// Sets [`material_ids`](Self::material_ids).
    #[must_use]
    pub const fn with_material_ids(mut self, material_ids: &'a wgpu::TextureView) -> Self {
        self.material_ids = Some(material_ids);
        self
    }

    /// Sets [`viewport`](Self::viewport).
    #[must_use]
    pub const fn with_viewport(mut self, viewport: Viewport) -> Self {
        self.viewport = Some(viewport);
        self
    }

    /// Checks the inputs for a pass of these settings; returns their size and the viewport.
    pub(super) fn check(
        &self,
        device: &wgpu::Device,
        settings: &Settings,
    ) -> Result<(Extent, Viewport), BindError> {
        let irradiance = Input::new("irradiance", self.irradiance).check(device, Holds::Colours)?;
        irradiance.size().check(device)?;
        let of_surface = if settings.has_material_ids() { Holds::Colours } else { Holds::ColoursAndNumbers };
        Input::new("surface", self.surface).check(device, of_surface)?.as_large_as(irradiance)?;
        Input::new("depth", self.depth).check(device, Holds::Numbers)?.as_large_as(irradiance)?;
        if let Some(scale) = self.mean_free_path_scale {
            Input::new("mean_free_path_scale", scale).check(device, Holds::Floats)?;
        }
        match (settings.has_material_ids(), self.material_ids) {
            (true, None) => return Err(BindError::MaterialIdsMissing),
            (false, Some(_)) => return Err(BindError::MaterialIdsUnexpected),
            (true, Some(ids)) => {
                Input::new("material_ids", ids)
                    .check(device, Holds::WholeNumbers)?
                    .as_large_as(irradiance)?;
            }
            (false, None) => {}
        }
        match (settings.stencil, self.depth_stencil) {
            (Some(_), None) => return Err(BindError::StencilMissing),
            (None, Some(view)) => {
                return Err(BindError::StencilUnexpected { found: view.texture().format() });
            }
            (Some(expected), Some(view)) => {
                let input = Input::new("depth_stencil", view);
                let found = input.texture.format();
                if found != expected {
                    return Err(BindError::StencilFormat { expected, found });
                }
                input.can_be(wgpu::TextureUsages::RENDER_ATTACHMENT)?;
                input.as_large_as(irradiance)?;
            }
            (None, None) => {}
        }
        let size = irradiance.size();
        let viewport = self.viewport.unwrap_or(Viewport::whole(size));
        if !viewport.is_within(size) {
            return Err(BindError::Viewport { viewport, size });
        }
        Ok((size, viewport))
    }

    pub(super) fn keep(&self) -> KeptInputs {
        KeptInputs {
            irradiance: self.irradiance.clone(),
            surface: self.surface.clone(),
            depth: self.depth.clone(),
            depth_stencil: self.depth_stencil.cloned(),
            mean_free_path_scale: self.mean_free_path_scale.cloned(),
            material_ids: self.material_ids.cloned(),
            viewport: self.viewport,
        }
    }
}

/// Inputs that the pass keeps, for kernels to come.
#[derive(Debug)]
pub(super) struct KeptInputs {
    irradiance: wgpu::TextureView,
    surface: wgpu::TextureView,
    depth: wgpu::TextureView,
    depth_stencil: Option<wgpu::TextureView>,
    mean_free_path_scale: Option<wgpu::TextureView>,
    material_ids: Option<wgpu::TextureView>,
    viewport: Option<Viewport>,
}

impl KeptInputs {
    pub(super) fn inputs(&self) -> SubsurfaceInputs<'_> {
        SubsurfaceInputs {
            irradiance: &self.irradiance,
            surface: &self.surface,
            depth: &self.depth,
            depth_stencil: self.depth_stencil.as_ref(),
            mean_free_path_scale: self.mean_free_path_scale.as_ref(),
            material_ids: self.material_ids.as_ref(),
            viewport: self.viewport,
        }
    }
}
