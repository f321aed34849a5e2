//! The numbers of a light, and how they lie in rows.

/// The rows of a light: see [`PunctualRow`].
pub type PunctualRows = [[f32; 4]; 5];

/// Equal in all directions.
pub const EVEN: u32 = 0;
/// A cone whose falloff depends on the cosine.
pub const BY_COSINE: u32 = 1;
/// A cone whose falloff depends on the angle.
pub const BY_ANGLE: u32 = 2;
/// The first image. It is white; images follow.
pub const PICTURE: u32 = 3;

/// The numbers of a light, or of a light in each lane. A light is a cone or an image, so they share places.
#[derive(Clone, Copy)]
pub struct PunctualRow<T> {
    /// Position; of directional lights the unit direction towards them.
    pub origin: [T; 3],
    /// 1; 0 for directional lights.
    pub w: T,
    /// Power of the beam on its axis.
    pub power: [T; 3],
    /// Bits of the shape: [`EVEN`], [`BY_COSINE`], [`BY_ANGLE`], or [`PICTURE`] plus the number of the image.
    pub shape: T,
    /// Axis of a cone; x form of a projector.
    pub axis_or_x: [T; 3],
    /// Edge of the cone: its cosine, or its angle as negative turns.
    pub edge: T,
    /// Falloff of a cone: coefficients of t, t² and t³; y form of a projector.
    pub falloff_or_y: [T; 3],
    /// The factor that makes t; 0 for an image without a cone.
    pub factor: T,
    /// The z form of an image: its axis.
    pub z: [T; 3],
    /// Length of the z form of a flat image; 0 for others.
    pub length: T,
}

impl<T: Copy> PunctualRow<T> {
    pub fn pack(&self) -> [[T; 4]; 5] {
        let row = |[x, y, z]: [T; 3], w| [x, y, z, w];
        [
            row(self.origin, self.w),
            row(self.power, self.shape),
            row(self.axis_or_x, self.edge),
            row(self.falloff_or_y, self.factor),
            row(self.z, self.length),
        ]
    }

    #[inline(always)]
    pub fn read(rows: [[T; 4]; 5]) -> Self {
        let [[x, y, z, w], [r, g, b, shape], [ax, ay, az, edge], [fx, fy, fz, factor], [zx, zy, zz, length]] = rows;
        PunctualRow {
            origin: [x, y, z],
            w,
            power: [r, g, b],
            shape,
            axis_or_x: [ax, ay, az],
            edge,
            falloff_or_y: [fx, fy, fz],
            factor,
            z: [zx, zy, zz],
            length,
        }
    }
}
