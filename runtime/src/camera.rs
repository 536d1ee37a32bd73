//! Where the picture is taken from.

use glam::{Mat4, Vec3};

/// A perspective camera in a right-handed world, y up.
///
/// ```
/// use subsurface_runtime::Camera;
///
/// let camera = Camera { position: [0.1, 0.2, 0.5], ..Default::default() };
/// assert_eq!((camera.target, camera.fov_y_radians), ([0.0; 3], 0.5));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Position in world units; by default (0, 0, 1).
    pub position: [f32; 3],
    /// Point it looks at, in world units; must differ from the position. By default the origin.
    pub target: [f32; 3],
    /// Vertical field of view in radians, 0 to π; by default 0.5, about 29 degrees.
    pub fov_y_radians: f32,
}

impl Default for Camera {
    fn default() -> Self {
        Self { position: [0.0, 0.0, 1.0], target: [0.0; 3], fov_y_radians: 0.5 }
    }
}

/// A sphere and a box around all that is drawn: shadow maps are fitted to both, and the near plane to the sphere.
///
/// ```
/// use subsurface_runtime::Bounds;
///
/// let head = Bounds::of_box([-0.1, -0.2, -0.1], [0.1, 0.1, 0.15]);
/// assert_eq!(head.half_extents[1], 0.15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// Centre of both in world units.
    pub centre: [f32; 3],
    /// Radius of the sphere in world units, > 0.
    pub radius: f32,
    /// Half the edges of the box in world units.
    pub half_extents: [f32; 3],
}

impl Bounds {
    /// A sphere of `radius` around `centre`, in world units.
    pub const fn new(centre: [f32; 3], radius: f32) -> Self {
        Self { centre, radius, half_extents: [radius; 3] }
    }

    /// A box from corner to corner, in world units: shadow maps fit it better than the sphere around it. A single point
    /// still gets a sphere of a tenth of a millionth.
    pub fn of_box(minimum: [f32; 3], maximum: [f32; 3]) -> Self {
        let [minimum, maximum] = [minimum, maximum].map(Vec3::from);
        let half = (0.5 * (maximum - minimum)).max(Vec3::ZERO);
        let centre = (0.5 * (minimum + maximum)).to_array();
        Self { centre, radius: half.length().max(1e-7), half_extents: half.to_array() }
    }

    /// How far they reach from their centre along a unit vector.
    pub(crate) fn reach(&self, direction: Vec3) -> f32 {
        direction.abs().dot(Vec3::from(self.half_extents)).min(self.radius)
    }

    /// The corners of the box.
    pub(crate) fn corners(&self) -> [Vec3; 8] {
        std::array::from_fn(|corner| {
            let side = |axis: usize| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
            Vec3::from(self.centre) + Vec3::new(side(0), side(1), side(2)) * Vec3::from(self.half_extents)
        })
    }
}

impl Camera {
    /// Clip space from view space for a frame of this aspect, its near plane before `bounds`.
    ///
    /// Where the camera stands within the bounds, that is at a hundredth of the distance to its target, or at a thousandth
    /// of the bounds: what is near is not cut off because something else is a kilometre away. Depth is reversed, 1 at the
    /// near plane and 0 infinitely far: as precise far as near, where the device's depth is a float.
    pub fn projection(&self, aspect: f32, bounds: &Bounds) -> [[f32; 4]; 4] {
        let [position, target, centre] = [self.position, self.target, bounds.centre].map(Vec3::from);
        let distance = position.distance(centre);
        let within = (1e-2 * position.distance(target)).min(1e-3 * (distance + bounds.radius));
        let near = (distance - bounds.radius).max(within);
        glam::camera::rh::proj::directx::perspective_infinite_reverse(self.fov_y_radians, aspect, near)
            .to_cols_array_2d()
    }

    /// View space from world space.
    pub(crate) fn view_from_world(&self) -> Mat4 {
        let position = Vec3::from(self.position);
        let forward = (Vec3::from(self.target) - position).try_normalize().unwrap_or(Vec3::NEG_Z);
        glam::camera::rh::view::look_to_mat4(position, forward, upright(forward))
    }
}

/// An up direction that is not parallel to `forward`: y, or x where the camera looks straight up or down.
pub(crate) fn upright(forward: Vec3) -> Vec3 {
    if forward.y.abs() > 0.999 { Vec3::X } else { Vec3::Y }
}
