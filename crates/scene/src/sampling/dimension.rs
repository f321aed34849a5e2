//! The coordinates of a path: which decision reads which.

/// The coordinate of the unit cube that a decision reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Dimension(pub u32);

impl Dimension {
    /// The point within the pixel (two coordinates).
    pub const PIXEL: Dimension = Dimension(0);
    /// The point on the lens (two).
    pub const LENS: Dimension = Dimension(2);
    /// The time between the opening and the closing of the shutter (one).
    pub const TIME: Dimension = Dimension(4);
    const PER_BOUNCE: u32 = 16;

    /// The first bounce of the light path. It counts like one of the camera path that no camera path reaches.
    pub const LIGHT_PATH: u32 = 1 << 20;

    /// The point of the disk or of the surface where light starts (two).
    pub const LIGHT_PLACE: Dimension = Dimension::direction(Dimension::LIGHT_PATH);
    /// The side where it starts (one).
    pub const LIGHT_SIDE: Dimension = Dimension(Dimension::PER_BOUNCE * Dimension::LIGHT_PATH + 3);
    /// The light, and the coin of the table that chooses it (two).
    pub const LIGHT_TABLE: Dimension = Dimension(Dimension::PER_BOUNCE * Dimension::LIGHT_PATH + 6);
    /// The direction in which it starts (two).
    pub const LIGHT_DIRECTION: Dimension = Dimension(Dimension::PER_BOUNCE * Dimension::LIGHT_PATH + 8);
    /// The cell of an image environment where it starts (two).
    pub const LIGHT_CELL: Dimension = Dimension(Dimension::PER_BOUNCE * Dimension::LIGHT_PATH + 10);

    /// Whether the coordinate belongs to the camera or one of the first three surfaces.
    pub(super) fn is_near(self) -> bool {
        self.0 < 4 * Self::PER_BOUNCE
    }

    /// The direction of the path after its `bounce`-th surface, counted from 1 (two).
    pub const fn direction(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce)
    }

    /// Whether the path survives after its `bounce`-th surface (one).
    pub fn roulette(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce + 2)
    }

    /// The lobe of the BSDF that the direction is sampled from (one).
    pub fn lobe(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce + 3)
    }

    /// The choice of the light at the `bounce`-th surface (one).
    pub fn light_choice(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce + 4)
    }

    /// The direction to the light (two).
    pub fn light(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce + 6)
    }

    /// The cell of an image environment (two).
    pub fn cell(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce + 8)
    }

    /// Whether the path meets a surface that lets light pass, on the way to its `bounce`-th surface (one).
    pub fn opacity(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce + 10)
    }

    /// The part of a blend that the path meets, on the way to its `bounce`-th surface (one).
    pub fn blend(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce + 11)
    }

    /// The part of a blend that the light sample of the `bounce`-th surface crosses (one).
    pub fn shadow_blend(bounce: u32) -> Dimension {
        Dimension(Self::PER_BOUNCE * bounce + 12)
    }
}
