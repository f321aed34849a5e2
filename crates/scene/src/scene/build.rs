//! Building scenes in code.
use std::{path::Path, sync::Arc, time::Instant};

use super::{
    Scene, SceneText,
    compile::{Before, Files, compile},
    damage::Damage,
    description::{EmissionDescription, MaterialDescription, ObjectDescription, SceneDescription},
    diagnostic::SceneError,
};
use crate::{light::emission::radiance::Radiance, material::Material, shape::ShapeKind};
use noisefall_base::{
    declare::{self, Assets, Precision, Problem},
    progress::Progress,
};

impl SceneDescription {
    /// Adds a material, or replaces the one of this name. Returns it for further changes.
    pub fn add_material(&mut self, name: &str, kind: impl Into<Material>) -> &mut MaterialDescription {
        let material = self.materials.entry(name.to_owned()).or_default();
        *material = MaterialDescription { kind: kind.into(), ..MaterialDescription::default() };
        material
    }

    /// Adds a black object that emits nothing. Returns it for further changes.
    pub fn add_object(&mut self, name: &str, shape: impl Into<ShapeKind>) -> &mut ObjectDescription {
        let object = ObjectDescription { name: name.to_owned(), shape: shape.into(), ..ObjectDescription::default() };
        self.objects.push_mut(object)
    }

    /// Checks the description as the reader of scene files does, and compiles it. Files that it names are looked for in `folder`.
    pub fn build(&self, folder: &Path) -> Result<Scene, SceneError> {
        let text = self.to_text();
        let files = Files { folder, ..Files::default() };
        self.compiled(SceneText::new(Box::new(move || text)), None, files, None)
    }

    /// Builds the scene of a file in another format, which errors name. Files are looked for in `assets` and in the folder of the
    /// file. The text of the scene is written at its first use.
    pub fn build_with(self: &Arc<Self>, file: &Path, assets: Assets) -> Result<Scene, SceneError> {
        self.build_watched(file, assets, &Progress::default())
    }

    /// Builds the scene of a file in another format, with progress and cancellation.
    pub fn build_watched(self: &Arc<Self>, file: &Path, assets: Assets, progress: &Progress) -> Result<Scene, SceneError> {
        let files = Files { folder: file.parent().unwrap_or(Path::new("")), assets, progress: progress.clone() };
        self.compiled(self.later_text(), Some(file), files, None)
    }

    /// Builds a changed scene. Reuses equal parts of `before`, which can be any scene of the same folder and files in memory. With
    /// [`Precision::Exact`] the scene has the same bits as from [`SceneDescription::build`].
    ///
    /// [`Precision::Interactive`] is faster, and may give other bits. [`Scene::is_exact`] then returns false, and the scene should be
    /// compiled again when there is time.
    ///
    /// ```
    /// use std::{path::Path, sync::Arc};
    ///
    /// use noisefall_base::declare::Precision;
    /// use noisefall_scene::{scene::description::SceneDescription, shape::kinds::Mesh};
    ///
    /// let mut scene = SceneDescription::default();
    /// scene.add_object("knot", Mesh::default());
    /// let before = scene.build(Path::new("."))?;
    /// scene.camera.fov = Some(20.0);
    /// let after = Arc::new(scene).rebuild(Path::new("."), &before, Precision::Exact)?;
    /// assert_eq!((before.compiled.made("mesh trees"), after.compiled.made("mesh trees")), (1, 0));
    /// # Ok::<(), noisefall_scene::scene::SceneError>(())
    /// ```
    pub fn rebuild(self: &Arc<Self>, folder: &Path, before: &Scene, precision: Precision) -> Result<Scene, SceneError> {
        let files = Files { folder, assets: before.assets.clone(), ..Files::default() };
        self.compiled(self.later_text(), None, files, Some(Before { scene: before, precision }))
    }

    fn later_text(self: &Arc<Self>) -> SceneText {
        let description = self.clone();
        SceneText::new(Box::new(move || description.to_text()))
    }

    /// Errors begin with the name of the file, if the scene has one.
    fn compiled(&self, text: SceneText, file: Option<&Path>, files: Files, before: Option<Before>) -> Result<Scene, SceneError> {
        let start = Instant::now();
        let mut problems = declare::check(&mut self.clone());
        if problems.is_empty() {
            match compile(self, text, files, &Damage::default(), before) {
                Ok(mut scene) => {
                    scene.compiled.took = start.elapsed();
                    return Ok(scene);
                }
                Err(found) => problems = found,
            }
        }
        let error = |problem: Problem| {
            let message = format!("{}: {}", self.place_name(&problem.path), problem.message);
            let advice = [problem.label, problem.help].into_iter().filter(|text| !text.is_empty()).collect::<Vec<_>>().join("; ");
            match file {
                Some(file) => SceneError::of_file(file, message, advice),
                None => SceneError::of_part(&message, &advice),
            }
        };
        let nothing = || SceneError::of_part("the scene cannot be compiled", "check its values");
        Err(SceneError::of_all(problems.into_iter().map(error).collect()).unwrap_or_else(nothing))
    }

    /// The text of a scene file with the same content.
    pub fn to_text(&self) -> String {
        declare::write(&mut self.clone()).to_string()
    }
}

impl EmissionDescription {
    /// Emission of a constant radiance, W·sr⁻¹·m⁻², from the front.
    pub fn radiance(radiance: [f64; 3]) -> EmissionDescription {
        EmissionDescription { source: Radiance { radiance }.into(), ..EmissionDescription::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        material::Lambertian,
        scene::{describe, parse},
        shape::Sphere,
    };

    fn light() -> SceneDescription {
        let mut description = SceneDescription::default();
        description.add_material("white", Lambertian::default());
        let ball = description.add_object("ball", Sphere::default());
        ball.material = Some("white".to_owned());
        description.add_object("light", Sphere { radius: 0.5, ..Sphere::default() }).emission =
            Some(EmissionDescription::radiance([3.0, 2.0, 1.0]));
        description
    }

    #[test]
    fn a_scene_built_in_code_is_the_one_of_its_text() {
        let description = light();
        let built = description.build(Path::new("")).expect("the description is valid");
        assert_eq!(describe("text", built.source.clone()).expect("the text is valid"), description);
        let parsed = parse("text", built.source.clone()).expect("the text is valid");
        assert_eq!((&built.owners, built.camera), (&parsed.owners, parsed.camera));
        // Emitting objects come first.
        assert_eq!(built.objects[0].name, "light");
        assert_eq!([0, 1].map(|object| built.objects[object].described), [1, 0]);
        assert!(built.material(&built.objects[1]).is_some());
    }

    #[test]
    fn a_scene_built_in_code_is_checked_as_a_file_is() {
        let refused = |change: fn(&mut SceneDescription), message: &str| {
            let mut description = light();
            change(&mut description);
            let error = description.build(Path::new("")).err().expect("it is invalid").report();
            // The report breaks its lines.
            let line = error.replace('│', " ").split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(line.contains(message), "{error}");
        };
        refused(|scene| scene.camera.look_at = scene.camera.eye, "the same point");
        refused(|scene| scene.objects[0].shape = Sphere { radius: -1.0, ..Sphere::default() }.into(), "radius");
        refused(|scene| scene.objects[0].material = Some("wite".to_owned()), "did you mean `white`");
        refused(|scene| scene.add_material("white", Lambertian { albedo: [1.5; 3].into() }).two_sided = None, "albedo");
    }
}
