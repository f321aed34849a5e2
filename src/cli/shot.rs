//! One image of `noisefall render`: rendered, written, and reported.
use std::{path::Path, process::ExitCode, sync::Arc, time::Instant};

use noisefall_formats::import::Remarks;
use noisefall_render::render::{
    Display, Frame, Published, RenderRequest, State, Status, checkpoint::MIXED_KEY, denoise, pass::SampleId,
    reference::Reference, replay_command::replay_command, settings_text::settings_text, threads::Threads,
};
use noisefall_scene::scene::{Camera, RenderSettings, Scene};

use super::{
    layers::Layers,
    messages::{Failure, tell},
    progress::Rendering,
    sequence::{Shot, UNFINISHED},
    stop::INTERRUPTED,
    summary::Done,
};

/// The scene, settings and options that all images of a command share.
pub struct Job<'a> {
    pub scene: Arc<Scene>,
    pub scene_path: &'a Path,
    pub settings: RenderSettings,
    pub display: Display,
    pub layers: &'a Layers,
    pub denoises: bool,
    pub reference: Option<Reference>,
    /// Threads for layers and denoising, as many as the worker has.
    pub threads: Threads,
    pub build_seconds: f64,
    pub is_sequence: bool,
    /// The options of the scene as words of a command.
    pub scene_options: String,
    /// Parts of the scene that were not imported exactly.
    pub scene_remarks: Remarks,
    pub json: bool,
}

impl Job<'_> {
    /// Returns the request to render an image.
    pub fn request(&self, shot: &Shot) -> RenderRequest {
        RenderRequest { scene: self.scene.clone(), camera: shot.camera, settings: self.settings }
    }

    /// Renders an image, writes it, and prints its line. A frame of a sequence is written only when it is finished.
    pub fn render(&self, rendering: &mut Rendering, shot: &Shot) -> Result<ExitCode, Failure> {
        let start = Instant::now();
        let request = self.request(shot);
        let picture = rendering.picture(request.clone())?;
        if !self.is_sequence {
            rendering.suspend(|| rendering.tell_how_to_go_on(&shot.output));
        }
        let render_seconds = (rendering.earlier() + start.elapsed()).as_secs_f64();
        self.failure(&picture.status, &shot.camera).map_or(Ok(()), Err)?;
        let has_bounces = self.layers.has_bounces() && !rendering.is_interrupted();
        let bounces = if has_bounces { Some(rendering.series(request)?) } else { None };
        let failure = bounces.as_ref().and_then(|bounces| self.failure(&bounces.status, &shot.camera));
        if self.is_sequence && rendering.is_interrupted() {
            rendering.suspend(|| tell(UNFINISHED));
            return Ok(ExitCode::from(INTERRUPTED));
        }
        match failure {
            Some(failure) if self.is_sequence => Err(failure),
            // The image itself is finished: only its layer is lost.
            Some(failure) => {
                rendering.suspend(|| self.deliver(shot, rendering.remarks(), &picture, None, render_seconds)).and(Err(failure))
            }
            None => {
                let bounces = bounces.map(|bounces| bounces.frame);
                // An interruption from here on cuts nothing.
                let is_cut = rendering.is_interrupted();
                let delivered = rendering
                    .suspend(|| self.deliver(shot, rendering.remarks(), &picture, bounces.as_deref(), render_seconds))?;
                Ok(if is_cut && delivered == ExitCode::SUCCESS { ExitCode::from(INTERRUPTED) } else { delivered })
            }
        }
    }

    /// The message of a render that failed.
    fn failure(&self, status: &Status, camera: &Camera) -> Option<Failure> {
        let State::Failed(failure) = &status.state else { return None };
        let replay = if failure.replays { format!("\nreplay: {}", self.replay(camera, failure.at)) } else { String::new() };
        Some(format!("the renderer failed: {}{replay}", failure.message))
    }

    /// The command that replays a sample.
    fn replay(&self, camera: &Camera, at: SampleId) -> String {
        replay_command(self.scene_path, &self.scene, camera.resolution, &self.settings, at) + &self.scene_options
    }

    /// Writes a rendered image, and prints its line. `mixed` says how it differs from one that was rendered in one go, and `bounces` is a
    /// frame with its series.
    fn deliver(
        &self,
        Shot { camera, output, .. }: &Shot,
        mixed: &[String],
        Published { frame, status }: &Published,
        bounces: Option<&Frame>,
        render_seconds: f64,
    ) -> Result<ExitCode, Failure> {
        let denoised = if self.denoises { self.denoised(frame) } else { None };
        let (frame, is_denoised) = (denoised.as_ref().unwrap_or(frame), denoised.is_some());
        let channels = self.layers.channels(&self.scene, camera, frame, bounces, &self.threads)?;
        let denoised = is_denoised.then(|| (denoise::LABEL_KEY, denoise::LABEL.to_owned()));
        let mixed = (!mixed.is_empty()).then(|| (MIXED_KEY, mixed.join("; ")));
        let remarks: Vec<_> = denoised.into_iter().chain(mixed).collect();
        let text = settings_text(&self.scene, camera, &self.settings, self.display, frame, &remarks);
        let delivered = output.write(frame, &channels, self.display, &text)?;
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
            error: reference.and_then(|truth| truth.compare(frame).zip(truth.bias(frame))),
            contradiction: reference.and_then(|truth| truth.contradiction(frame)),
            replay: status.first_invalid.map(|at| self.replay(camera, at)),
            frame,
            status,
            is_denoised,
            threads: self.threads.count(),
            seconds: [self.build_seconds, render_seconds],
        };
        done.notes(camera).iter().for_each(|note| tell(note));
        output.report(&if self.json { done.json().to_string() } else { done.line() })?;
        Ok(delivered)
    }

    /// A frame without its noise, nor its noise estimate. `None`, with a warning, if it has no half images.
    fn denoised(&self, frame: &Frame) -> Option<Frame> {
        let Some(radiance) = self.threads.install(|| denoise::denoised(frame, &|| false)) else {
            tell("warning: the image is not denoised: denoising needs two samples of every pixel, and memory for half images");
            return None;
        };
        tell(&format!("warning: {}", denoise::LABEL));
        let Frame { width, height, full_resolution, spp, path_reuse, elapsed, .. } = *frame;
        let counts = frame.counts.clone();
        Some(Frame { width, height, full_resolution, radiance, spp, counts, path_reuse, elapsed, ..Frame::default() })
    }

    /// Whether it is the scene's own camera, whose image the scene may know.
    fn is_of_scene(&self, camera: &Camera) -> bool {
        Camera { resolution: camera.resolution, ..self.scene.camera } == *camera
    }
}
