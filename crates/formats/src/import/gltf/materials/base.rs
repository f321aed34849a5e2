//! The base of a material: colour, metal and roughness.
use super::MaterialImport;
use crate::import::gltf::document::MetallicRoughness;
use noisefall_base::declare::Textured;
use noisefall_scene::{material::principled::Principled, texture::image::Channel};

impl MaterialImport<'_, '_> {
    /// The whole of what reflects and transmits.
    pub(super) fn principled(&mut self) -> Principled {
        let mut principled = match self.extensions.specular_glossiness.as_deref() {
            Some(described) => self.specular_glossiness(described),
            None => self.metallic_roughness(),
        };
        self.transmission(&mut principled);
        self.coat(&mut principled);
        self.sheen(&mut principled);
        self.iridescence(&mut principled);
        self.anisotropy(&mut principled);
        principled
    }

    pub(super) fn described(&self) -> MetallicRoughness {
        self.material.pbr_metallic_roughness.as_deref().cloned().unwrap_or_default()
    }

    fn metallic_roughness(&mut self) -> Principled {
        let described = self.described();
        let map = described.metallic_roughness_texture.as_ref();
        let base_color = self.base_colour();
        let mut principled = Principled {
            base_color,
            base_metalness: self.number("metallicFactor", described.metallic_factor, map, Channel::Blue),
            // Both are the square root of the width of the microfacet distribution.
            specular_roughness: self.number("roughnessFactor", described.roughness_factor, map, Channel::Green),
            ..Principled::default()
        };
        self.interface(&mut principled);
        principled
    }

    /// The colour without its opacity, times that of the vertices.
    pub(super) fn base_colour(&mut self) -> Textured {
        let described = self.described();
        let [r, g, b, _] = described.base_color_factor;
        let colour = self.unit_colour("baseColorFactor", [r, g, b], described.base_color_texture.as_ref());
        self.with_vertices(colour)
    }
}
