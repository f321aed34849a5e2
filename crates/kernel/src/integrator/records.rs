//! The records in the queues of a batch.
use super::queue::record;

record! {
    /// A path on its way to the next surface.
    Path {
        o: V,
        /// Unit.
        d: V,
        /// Product of f cos/p and of the roulette weights so far.
        throughput: V,
        slot: U,
    }
}

record! {
    /// The previous vertex of a path, for the MIS weight of an emitter hit: see [`super::weight`].
    PreviousVertex {
        /// Shading normal on the viewer's side.
        n: V,
        /// Pdf of the path's direction, per solid angle.
        pdf: F,
        flags: U,
    }
}

record! {
    /// The [`noisefall_scene::light::Lobe`] of the previous vertex. Stored beside [`PreviousVertex`] if light samples depend on lobes.
    PreviousLobe {
        wo: V,
        alpha: F,
    }
}

/// Flag of [`PreviousVertex`]: the direction comes from a delta lobe, so no light sample could have had it.
pub(super) const DELTA: u32 = 1;
/// Flag of [`PreviousVertex`]: lights were sampled on both sides of the surface.
pub(super) const TRANSMITS: u32 = 2;

record! {
    /// The media around a path, innermost in the lowest byte. Stored beside paths and light samples in scenes with media.
    MediumStack {
        media: U,
    }
}

record! {
    /// A path at a surface that reflects.
    Hit {
        /// Origin of the next ray: the surface point, offset from the surface by its error.
        p: V,
        /// Unit geometric normal on the side the path arrived from.
        n: V,
        /// Albedo or reflectance.
        colour: V,
        throughput: V,
        slot: U,
    }
}

record! {
    /// Further data for shading of surfaces that are more than diffuse.
    Detail {
        /// Unit, towards the viewer.
        wo: V,
        /// Unit shading normal on the side the path arrived from.
        n: V,
        alpha: F,
        /// Offset of [`Hit::p`] from the surface.
        error: F,
        /// Word of the surface (see [`noisefall_scene::scene::surface`]), with its flag `FRONT` if the path arrived at the front.
        surface: U,
        /// Media on the side the path arrived from, and the one inside the surface.
        media: U,
        medium: U,
    }
}

record! {
    /// Where a path is on a surface, in scenes with materials whose shading reads it. Stored beside [`Detail`].
    SurfaceCoordinates {
        /// Texture coordinates.
        u: F,
        v: F,
        /// The tangent, of any length.
        along_u: V,
        /// 1 if the bitangent is on the left of the tangent seen from the front, −1 if it is on the right.
        handedness: F,
        /// Colour and opacity of vertices, in scenes with textures that read them.
        vertex: V,
        vertex_opacity: F,
    }
}

record! {
    /// Shadowing by tilted shading normals. Stored beside [`Detail`] in scenes with surfaces that have it.
    NormalShadowing {
        /// The normal before it was tilted, unit, on the side the path arrived from.
        n: V,
        /// See [`super::normal_shadowing`].
        alpha_squared: F,
    }
}

record! {
    /// Normals of bump and normal maps, for viewers in any direction. Stored beside [`Detail`] for bidirectional paths.
    MappedNormals {
        /// The smooth normal, on the side the path arrived from.
        smooth: V,
        /// The normal of the surface, tilted.
        tilted_surface: V,
        /// Flags in [`noisefall_scene::scene::surface::Surfaces::relief`].
        flags: U,
    }
}

record! {
    /// The diffuse transmittance of a surface. Stored beside [`Hit`] for types of BSDF that have one.
    Transmittance {
        colour: V,
    }
}

record! {
    /// A light sample, visible if the first surface along its ray is the target.
    Shadow {
        o: V,
        d: V,
        /// Its contribution to the pixel if it is visible.
        radiance: V,
        target: U,
        slot: U,
    }
}
