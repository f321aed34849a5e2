//! Camera paths: a TOML file of cameras with times, and smooth interpolation between them.
//!
//! ```toml
//! frames = 120
//!
//! [[camera]]
//! time = 0.0
//! eye = [0.0, 1.0, 4.0]
//! look_at = [0.0, 1.0, 0.0]
//! ```
use std::{
    ops::{Add, Mul, Sub},
    path::Path,
};

use glam::DVec3;
use toml::de::DeTable;

use super::{
    Camera, Lens, SceneError, diagnostic::SourceText, load::read_text, parse::check_nesting, read::read, wording::in_plain_words,
};
use noisefall_base::declare::{CountRange, Declare, Parameter, Parameters, Range};

/// Cameras at given times.
#[derive(Clone, Debug, PartialEq)]
pub struct CameraPath {
    frames: u32,
    keys: Vec<CameraKey>,
}

/// A camera of a path; `None` is the value of the scene's camera.
#[derive(Clone, Debug, Default, PartialEq)]
struct CameraKey {
    time: f64,
    eye: DVec3,
    look_at: DVec3,
    up: Option<DVec3>,
    fov: Option<f64>,
    focus: Option<f64>,
}

impl Declare for CameraPath {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const FRAMES: Parameter = Parameter::new("frames", "Number of frames, at equal times from the first camera to the last.");
        const CAMERA: Parameter = Parameter::new("camera", "A camera at a time.").aliases("cameras key keys");
        p.count(&FRAMES.required(), &mut self.frames, CountRange::new(2, 100_000));
        p.list(&CAMERA, &mut self.keys);
    }
}

impl Declare for CameraKey {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        const TIME: Parameter = Parameter::new("time", "Time of the camera, in any unit.").required().aliases("t at");
        const EYE: Parameter = Parameter::new("eye", "Position of the camera.").unit("m").required();
        const LOOK_AT: Parameter = Parameter::new("look_at", "Point at the centre of the image.").unit("m").required();
        const UP: Parameter = Parameter::new("up", "Direction that points up in the image. Default: that of the scene.");
        const FOV: Parameter = Parameter::new("fov", "Field of view across the width. Default: that of the scene.").unit("°");
        const FOCUS: Parameter = Parameter::new("focus", "Distance in focus of a lens. Default: that of the scene.").unit("m");
        p.number(&TIME, &mut self.time, Range::linear(-1e9, 1e9));
        p.point(&EYE, &mut self.eye);
        p.point(&LOOK_AT, &mut self.look_at);
        p.optional(&UP, &mut self.up, || DVec3::Y, |p, up| p.point(&UP, up));
        p.optional(&FOV, &mut self.fov, || 40.0, |p, fov| p.number(&FOV, fov, Range::linear(0.001, 179.9)));
        p.optional(&FOCUS, &mut self.focus, || 1.0, |p, focus| p.number(&FOCUS, focus, Range::log(1e-9, 1e12)));
    }
}

impl CameraPath {
    /// Reads a file. Errors of syntax and of single values have their line.
    pub fn load(path: &Path) -> Result<CameraPath, SceneError> {
        CameraPath::parse(&path.display().to_string(), read_text(path)?)
    }

    /// The path in a text. `name` is its name in errors.
    pub fn parse(name: &str, text: String) -> Result<CameraPath, SceneError> {
        let source = SourceText { name: name.to_owned(), text };
        check_nesting(&source)?;
        let table = DeTable::parse(&source.text).map_err(|error| in_plain_words(&source, &error))?;
        let mut path = CameraPath { frames: 2, keys: Vec::new() };
        let (_, errors) = read(&mut path, &table, &source);
        SceneError::of_all(errors).map_or(Ok(()), Err)?;
        let refuse = |message: String, help| Err(SceneError::of_file(Path::new(name), message, help));
        if path.keys.len() < 2 {
            return refuse("a camera path needs two cameras or more".to_owned(), "each camera is a table `[[camera]]`");
        }
        match path.keys.windows(2).position(|pair| pair[0].time >= pair[1].time) {
            Some(early) => {
                refuse(format!("camera {} is not later than camera {}", early + 2, early + 1), "list the cameras by their times")
            }
            None => Ok(path),
        }
    }

    /// The cameras of all frames. `of_scene` gives what the path leaves open. Fails if a camera is impossible.
    pub fn cameras(&self, of_scene: &Camera) -> Result<Vec<Camera>, String> {
        if self.keys.iter().any(|key| key.focus.is_some()) && of_scene.lens.is_none() {
            return Err("the camera path has `focus`, but the scene's camera has no lens".to_owned());
        }
        let [first, last] = [&self.keys[0], &self.keys[self.keys.len() - 1]].map(|key| key.time);
        let time = |frame: u32| match f64::from(frame) / f64::from(self.frames - 1) {
            1.0 => last,
            part => first + (last - first) * part,
        };
        let camera = |frame: u32| {
            let camera = self.at(time(frame), of_scene);
            camera.check().map_err(|error| format!("frame {} of the camera path: {error}", frame + 1))?;
            Ok(camera)
        };
        (0..self.frames).map(camera).collect()
    }

    fn at(&self, time: f64, of_scene: &Camera) -> Camera {
        let focus = |lens: Lens| self.value(time, |key| key.focus.unwrap_or(lens.focus));
        Camera {
            eye: self.value(time, |key| key.eye),
            look_at: self.value(time, |key| key.look_at),
            up: self.value(time, |key| key.up.unwrap_or(of_scene.up)),
            fov: self.value(time, |key| key.fov.unwrap_or(of_scene.fov)),
            lens: of_scene.lens.map(|lens| Lens { focus: focus(lens), ..lens }),
            ..*of_scene
        }
    }

    /// Interpolates a value by cubic Hermite splines, whose slope at a key is that between its neighbours (E. Catmull and R. Rom, "A
    /// class of local interpolating splines", 1974, for unequal times). Values at the keys are exact.
    fn value<T>(&self, time: f64, of: impl Fn(&CameraKey) -> T) -> T
    where
        T: Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
    {
        let end = self.keys.len() - 1;
        let left = self.keys.iter().rposition(|key| key.time <= time).unwrap_or(0).min(end - 1);
        let at = |i: usize| of(&self.keys[i]);
        let slope = |i: usize| {
            let (before, after) = (i.saturating_sub(1), (i + 1).min(end));
            (at(after) - at(before)) * (1.0 / (self.keys[after].time - self.keys[before].time))
        };
        let width = self.keys[left + 1].time - self.keys[left].time;
        let s = (time - self.keys[left].time) / width;
        let (square, cube) = (s * s, s * s * s);
        at(left) * (2.0 * cube - 3.0 * square + 1.0)
            + slope(left) * ((cube - 2.0 * square + s) * width)
            + at(left + 1) * (3.0 * square - 2.0 * cube)
            + slope(left + 1) * ((cube - square) * width)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::built_in;

    const PATH: &str = "frames = 5
        [[camera]]
        time = 1.0
        eye = [0.0, 1.0, 4.0]
        look_at = [0.0, 1.0, 0.0]
        [[camera]]
        time = 2.0
        eye = [2.0, 1.0, 4.0]
        look_at = [0.0, 1.0, 0.0]
        fov = 20.0
        [[camera]]
        time = 5.0
        eye = [8.0, 1.0, 4.0]
        look_at = [0.0, 1.0, 0.0]
        fov = 20.0";

    #[test]
    fn a_path_passes_through_its_cameras_and_keeps_a_constant_speed() {
        let scene = built_in();
        let path = CameraPath::parse("path.toml", PATH.to_owned()).expect("it is right");
        let cameras = path.cameras(&scene.camera).expect("they are possible");
        let eyes: Vec<f64> = cameras.iter().map(|camera| camera.eye.x).collect();
        assert_eq!((eyes[0], eyes[1], eyes[4]), (0.0, 2.0, 8.0));
        assert!((eyes[2] - 4.0).abs() < 1e-12 && (eyes[3] - 6.0).abs() < 1e-12, "{eyes:?}");
        assert_eq!((cameras[0].fov, cameras[1].fov, cameras[4].fov), (scene.camera.fov, 20.0, 20.0));
        assert!(cameras.iter().all(|camera| camera.look_at.y == 1.0 && camera.resolution == scene.camera.resolution));
    }

    #[test]
    fn mistakes_are_reported_with_their_place() {
        let refused = |text: String| CameraPath::parse("path.toml", text).expect_err("it is refused").report();
        assert!(refused(PATH.replace("time = 2.0", "time = 1.0")).contains("camera 2 is not later than camera 1"));
        assert!(refused(PATH.replace("time = 2.0", "tim = 2.0")).contains("time"));
        assert!(refused("frames = 5".to_owned()).contains("two cameras or more"));
        assert!(!refused(PATH.replace("frames = 5", "frames = 1")).is_empty());
        let scene = built_in();
        let cameras = |text: String| CameraPath::parse("path.toml", text).expect("it is a path").cameras(&scene.camera);
        assert!(cameras(PATH.replace("fov = 20.0", "focus = 3.0")).is_err_and(|error| error.contains("no lens")));
        let same = PATH.replace("eye = [2.0, 1.0, 4.0]", "eye = [0.0, 1.0, 0.0]");
        assert!(cameras(same).is_err_and(|error| error.contains("frame 2") && error.contains("same point")));
    }
}
