//! The constants of a principled material in [`Materials`]: rows of the kind, and further rows with the parameters that may be
//! textured.
use super::super::Materials;
use noisefall_base::math::{F, Lanes, M, U};

/// Flags of a material: what some point of it may have.
pub const METAL: u32 = 1;
pub const COAT: u32 = 1 << 1;
pub const FUZZ: u32 = 1 << 2;
pub const FILM: u32 = 1 << 3;
pub const ANISOTROPIC: u32 = 1 << 4;
/// A thin sheet.
pub const SHEET: u32 = 1 << 5;
/// The table of the interface has rows for every roughness.
pub const VARIES: u32 = 1 << 6;
/// The interface is tinted, and not the inside.
pub const TINTED: u32 = 1 << 7;
/// The table of lost light has rows for every azimuth.
pub const TURNED: u32 = 1 << 8;

/// Further rows with a colour and a number: the number is the weight of the colour's layer.
pub const SPECULAR: u32 = 0;
pub const TRANSMISSION: u32 = 1;
pub const COATING: u32 = 2;
pub const FIBRES: u32 = 3;
/// Base weight, metalness, diffuse roughness, anisotropy.
pub const BASE: u32 = 4;
/// Roughness and anisotropy of the coat, darkening, roughness of the fuzz.
pub const LAYERS: u32 = 5;
/// Weight and thickness of the film.
pub const INTERFERENCE: u32 = 6;
/// Texture ids plus 1 of the four colours, of their weights, and of the numbers in [`BASE`], [`LAYERS`] and [`INTERFERENCE`], as bits.
pub const IDS_OF_COLORS: u32 = 7;
pub const IDS_OF_WEIGHTS: u32 = 8;
/// The ids of a row of numbers are this many rows later.
pub const TO_IDS: u32 = 5;
/// Number of further rows.
pub const FURTHER: usize = 12;

/// The constants that no texture varies.
pub struct Constants<T, I> {
    /// Index of refraction of the base.
    pub ior: T,
    /// Index of the coat.
    pub coat_ior: T,
    /// Index of the film.
    pub film_ior: T,
    /// Index of the table of the base, which may be rounded.
    pub table_ior: T,
    /// Cosine and sine of the tangent's rotation.
    pub turn: (T, T),
    pub flags: I,
    /// First rows of the tables of the base, of the coat, and of the interface.
    pub base_table: I,
    pub coat_table: I,
    pub interface_table: I,
    /// First further row; 0 before the material is added.
    pub further: I,
}

impl Constants<f32, u32> {
    pub fn pack(&self) -> [[f32; 4]; 3] {
        let Constants { ior, coat_ior, film_ior, table_ior, turn: (cos, sin), .. } = *self;
        let [flags, base, coat, interface, further] =
            [self.flags, self.base_table, self.coat_table, self.interface_table, self.further].map(f32::from_bits);
        [[ior, coat_ior, film_ior, table_ior], [cos, sin, flags, base], [coat, interface, 0.0, further]]
    }
}

impl<L: Lanes> Constants<F<L>, U<L>> {
    #[inline(always)]
    pub fn read(l: L, materials: &Materials, material: U<L>) -> Self {
        let [ior, coat_ior, film_ior, table_ior] = materials.row(l, material, 0);
        let [cos, sin, flags, base] = materials.row(l, material, 1);
        let [coat, interface, _, further] = materials.row(l, material, 2);
        Constants {
            ior,
            coat_ior,
            film_ior,
            table_ior,
            turn: (cos, sin),
            flags: flags.bits(),
            base_table: base.bits(),
            coat_table: coat.bits(),
            interface_table: interface.bits(),
            further: further.bits(),
        }
    }

    /// Lanes whose material has a flag.
    #[inline(always)]
    pub fn has(&self, flag: u32) -> M<L> {
        !(self.flags & flag).is(0)
    }
}
