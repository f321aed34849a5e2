//! Materials on the surfaces of objects.
use crate::{
    geometry::Shape,
    material::Stage,
    scene::{MaterialInstance, Object},
};

/// A material on a surface, with what the object and the blends around it change.
#[derive(Clone, Copy)]
pub struct AppliedMaterial<'a> {
    /// Number of the material.
    pub number: u32,
    pub instance: &'a MaterialInstance,
    /// Whether the normal is reversed.
    pub flip: bool,
    /// Whether the object emits.
    pub emits: bool,
    /// Whether the object has normals of its own.
    smooth: bool,
    pub one_sided: bool,
    pub bump: Option<(u32, f32)>,
    pub normal_map: Option<u32>,
    /// Whether bump and normal map darken light at grazing angles.
    pub normal_shadowing: bool,
    /// Whether normals that face away from the viewer are mirrored.
    pub mirrored_normals: bool,
    /// Whether the back shows bump and normal map as the front does.
    pub two_sided_relief: bool,
}

/// The properties of a surface that its row depends on, as bits.
pub type Key = [u32; 5];

impl<'a> AppliedMaterial<'a> {
    /// The material of an object, if it has one.
    pub fn of_object(object: &Object, instances: &'a [MaterialInstance]) -> Option<AppliedMaterial<'a>> {
        let number = object.material?;
        let instance = &instances[number as usize];
        Some(AppliedMaterial {
            number,
            instance,
            flip: object.flip,
            emits: object.emission.is_some(),
            smooth: matches!(&object.shape, Shape::Mesh { data, .. } if !data.normals.is_empty()),
            one_sided: instance.one_sided,
            bump: instance.bump,
            normal_map: instance.normal_map,
            normal_shadowing: instance.normal_shadowing,
            mirrored_normals: instance.mirrored_normals,
            two_sided_relief: instance.two_sided_relief,
        })
    }

    /// A part of a blend on the same surface. It is black from behind where the blend is, and has the blend's bump and normal map
    /// unless it has its own.
    pub fn part(&self, number: u32, instances: &'a [MaterialInstance]) -> AppliedMaterial<'a> {
        let instance = &instances[number as usize];
        AppliedMaterial {
            number,
            instance,
            one_sided: self.one_sided || instance.one_sided,
            bump: instance.bump.or(self.bump),
            normal_map: instance.normal_map.or(self.normal_map),
            normal_shadowing: self.normal_shadowing || instance.normal_shadowing,
            mirrored_normals: self.mirrored_normals || instance.mirrored_normals,
            two_sided_relief: self.two_sided_relief || instance.two_sided_relief,
            ..*self
        }
    }

    /// Diffuse surfaces need more than their plain stage where normals vary or there are media.
    pub fn stage(&self, has_media: bool) -> Stage {
        match self.instance.compiled.stage {
            Stage::Plain if self.has_normals() || self.smooth || has_media => Stage::Diffuse,
            stage => stage,
        }
    }

    /// Whether a bump or normal map tilts its normals.
    pub fn has_normals(&self) -> bool {
        self.bump.is_some() || self.normal_map.is_some()
    }

    /// Equal for surfaces with equal rows.
    pub fn key(&self) -> Key {
        let of_surface = [self.flip, self.emits, self.smooth, self.one_sided];
        let flags = of_surface.into_iter().chain([self.normal_shadowing, self.mirrored_normals, self.two_sided_relief]);
        let flags = flags.fold(0, |bits, flag| bits << 1 | u32::from(flag));
        let (bump, height) = self.bump.map_or((0, 0.0), |(id, height)| (id + 1, height));
        [self.number, flags, bump, height.to_bits(), self.normal_map.map_or(0, |id| id + 1)]
    }
}
