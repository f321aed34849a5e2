//! One image of `noisefall render`: rendered, written, and reported.
use std::{path::Path, process::ExitCode, sync::Arc, time::Instant};

use noisefall::{
    import::Remarks,
    math::SimdLevel,
    render::{
        Display, Frame, Published, RenderRequest, State, denoise, replay_command::replay_command, settings_text::settings_text,
        threads::Threads, truth::Reference,
    },
    scene::{Camera, RenderSettings, Scene},
};

use super::{
    layers::Layers,
    messages::{Failure, tell},
    progress::Rendering,
    sequence::Shot,
    stop::INTERRUPTED,
    summary::Done,
};

/// What all images of a command have in common.
pub struct Job<'a> {
    pub scene: Arc<Scene>,
    pub scene_path: &'a Path,
    pub settings: RenderSettings,
    pub display: Display,
    pub layers: &'a Layers,
    pub denoises: bool,
    pub reference: Option<Reference>,
    pub threads: usize,
    pub build_seconds: f64,
    pub is_sequence: bool,
    /// The options of the scene as words of a command.
    pub scene_options: String,
    /// What of the scene was not taken over exactly.
    pub scene_remarks: Remarks,
    pub json: bool,
}

impl Job<'_> {
    /// Renders an image, writes it, and prints its line. A frame of a sequence is written only when it is finished.
    pub fn render(&self, rendering: &mut Rendering, shot: &Shot) -> Result<ExitCode, Failure> {
        let Shot { camera, output } = shot;
        let start = Instant::now();
        let request = RenderRequest { scene: self.scene.clone(), camera: *camera, settings: self.settings };
        let Published { frame, status } = rendering.picture(request.clone())?;
        let render_seconds = start.elapsed().as_secs_f64();
        let replayed = |at| {
            let command = replay_command(self.scene_path, &self.scene, camera.resolution, &self.settings, at);
            command + &self.scene_options
        };
        if let State::Failed(failure) = &status.state {
            let replay = failure.replays.then(|| format!("\nreplay: {}", replayed(failure.at)));
            return Err(format!("the renderer failed: {}{}", failure.message, replay.unwrap_or_default()));
        }
        let has_bounces = self.layers.has_bounces() && !rendering.is_interrupted();
        let bounces = if has_bounces { Some(rendering.series(request)?.frame) } else { None };
        if self.is_sequence && rendering.is_interrupted() {
            tell("the sequence is not finished; the same command with --resume continues it");
            return Ok(ExitCode::from(INTERRUPTED));
        }
        let denoised = if self.denoises { Some(self.denoised(&frame)?) } else { None };
        let frame = denoised.map_or(frame, Arc::new);
        let channels = self.layers.channels(&self.scene, camera, &frame, bounces.as_deref(), self.threads)?;
        let text = settings_text(&self.scene, camera, &self.settings, self.display, &frame, &self.remarks());
        let delivered = output.write(&frame, &channels, self.display, &text)?;
        if delivered != ExitCode::SUCCESS {
            return Ok(delivered);
        }
        let reference = self.reference.as_ref().filter(|_| self.is_of_scene(camera));
        let done = Done {
            output,
            scene: &self.scene,
            scene_path: self.scene_path,
            remarks: &self.scene_remarks,
            settings: &self.settings,
            error: reference.and_then(|truth| truth.compare(&frame).zip(truth.bias(&frame))),
            contradiction: reference.and_then(|truth| truth.contradiction(&frame)),
            replay: status.first_invalid.map(replayed),
            frame: &frame,
            status: &status,
            threads: self.threads,
            seconds: [self.build_seconds, render_seconds],
        };
        rendering.suspend(|| {
            done.notes(camera).iter().for_each(|note| tell(note));
            output.report(&if self.json { done.json().to_string() } else { done.line() })
        })?;
        Ok(delivered)
    }

    /// A frame without its noise, nor its noise estimate.
    fn denoised(&self, frame: &Frame) -> Result<Frame, Failure> {
        let size = [frame.width, frame.height];
        let _memory = denoise::reserve(size).map_err(|error| error.to_string())?;
        let threads = Threads::new(self.threads, SimdLevel::best()).map_err(|error| error.to_string())?;
        let radiance = threads.install(|| denoise::denoised(frame, &|| false));
        let radiance = radiance.ok_or("--denoise needs two samples per pixel or more, and memory for half images")?;
        tell(&format!("note: {}", denoise::LABEL));
        let Frame { width, height, full_resolution, spp, shares, elapsed, .. } = *frame;
        let counts = frame.counts.clone();
        Ok(Frame { width, height, full_resolution, radiance, spp, counts, shares, elapsed, ..Frame::default() })
    }

    /// Settings that say what has been done to the image.
    fn remarks(&self) -> Vec<(&'static str, String)> {
        self.denoises.then(|| ("image", denoise::LABEL.to_owned())).into_iter().collect()
    }

    /// Whether it is the scene's own camera, whose image the scene may know.
    fn is_of_scene(&self, camera: &Camera) -> bool {
        Camera { resolution: camera.resolution, ..self.scene.camera } == *camera
    }
}
