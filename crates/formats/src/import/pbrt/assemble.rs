//! The last step of a translation: assigns materials, which are all known by then.
use super::import::Import;
use noisefall_scene::scene::{
    SceneError,
    description::{Material, ShapeKind},
};

impl Import {
    /// Gives all objects their materials, and remarks on what became of disks.
    pub fn assemble(&mut self) -> Result<(), SceneError> {
        for (index, covering) in std::mem::take(&mut self.coverings).into_iter().enumerate() {
            let covered = |import: &mut Import| import.material(&covering.material, covering.opacity.as_ref(), &covering.place);
            let Some(name) = self.part(covered)? else { continue };
            let is_interface = matches!(self.description.materials[&name].kind, Material::Null(_));
            let name = self.holding(name, &covering.inside, &covering.place)?;
            let object = &mut self.description.objects[index];
            object.material = Some(name);
            if is_interface && object.emission.take().is_some() {
                let found = "an area light with an interface as its material";
                self.remarks.add(covering.place.to_string(), found, "no light", "pbrt ignores the light too");
            }
        }
        self.remarks.extend(self.absorbers.remarks_of_open());
        self.remark_disks();
        if !self.moves {
            self.description.camera.shutter = None;
        }
        Ok(())
    }

    /// Coordinates of whole disks run along x and y here, and around the middle in pbrt.
    fn remark_disks(&mut self) {
        let textured = |name: &String| format!("{:?}", self.description.materials[name]).contains("Texture(\"");
        let is_textured_disk = |object: &&noisefall_scene::scene::description::ObjectDescription| {
            matches!(object.shape, ShapeKind::Disk(_)) && object.material.as_ref().is_some_and(textured)
        };
        let count = self.description.objects.iter().filter(is_textured_disk).count();
        for _ in 0..count {
            self.remarks.add(
                "Shape \"disk\"",
                "a textured disk",
                "texture coordinates along x and y",
                "the texture is placed differently",
            );
        }
    }
}
