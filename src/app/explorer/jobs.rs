//! The explorer's jobs: what takes longer than a frame, and what becomes of it.

use std::path::PathBuf;
use std::sync::Arc;

use egui::Context;

use super::Explorer;
use crate::app::action::Action;
use crate::app::dialogs::Dialog;
use crate::app::files::{self, Opened};
use crate::app::job::{Job, Outcome};
use crate::app::model::{JobLine, Surroundings};
use crate::app::panes;
use crate::app::picture::{self, Destination, PictureRequest};
use crate::gpu::{EnvironmentSource, EnvironmentTexture, Gpu};
use crate::imaging::Environment;

/// Surroundings that are on the device already.
pub(super) struct Ready {
    surroundings: Surroundings,
    texture: EnvironmentTexture,
}

impl Ready {
    /// Puts the surroundings on the device.
    pub(super) fn new(gpu: &Gpu, surroundings: Surroundings) -> Result<Self, String> {
        let image = &surroundings.loaded.image;
        let source = EnvironmentSource {
            width: image.width(),
            height: image.height(),
            pixels: image.pixels(),
        };
        let texture = EnvironmentTexture::new(gpu, source).map_err(|error| error.to_string())?;
        Ok(Self {
            surroundings,
            texture,
        })
    }
}

impl Explorer {
    pub(super) fn job_lines(&self) -> Vec<JobLine> {
        let line = |id: u64, title: &str, progress: &crate::imaging::Progress| JobLine {
            id,
            title: title.to_owned(),
            fraction: progress.fraction(),
        };
        let loading = self
            .loading
            .iter()
            .map(|job| line(job.id, &job.title, &job.progress));
        let opening = self
            .opening
            .iter()
            .map(|job| line(job.id, &job.title, &job.progress));
        let pictures = self
            .pictures
            .iter()
            .map(|(_, job)| line(job.id, &job.title, &job.progress));
        loading.chain(opening).chain(pictures).collect()
    }

    pub(super) fn job_id(&mut self) -> u64 {
        self.next_job += 1;
        self.next_job
    }

    /// Starts loading surroundings; an older load is cancelled.
    pub(super) fn load(&mut self, ctx: &Context, environment: Environment) {
        let (id, wake, gpu) = (self.job_id(), ctx.clone(), self.gpu.clone());
        let title = format!("opening {}", environment.name());
        let job = Job::start(
            id,
            title,
            move || wake.request_repaint(),
            move |progress| {
                let loaded = environment
                    .image(progress)
                    .map_err(|error| error.to_string())?;
                Ready::new(
                    &gpu,
                    Surroundings {
                        environment,
                        loaded: Arc::new(loaded),
                    },
                )
            },
        );
        match job {
            Ok(job) => self.loading = Some(job),
            Err(error) => self.fail(format!("no thread for opening the environment: {error}")),
        }
    }

    /// Opens a scene, a picture with a scene in it, or an environment, whichever the file is.
    pub(super) fn open(&mut self, ctx: &Context, path: PathBuf) {
        let (id, wake) = (self.job_id(), ctx.clone());
        let title = format!("reading {}", path.display());
        let job = Job::start(
            id,
            title,
            move || wake.request_repaint(),
            move |_| files::open(&path),
        );
        match job {
            Ok(job) => self.opening = Some(job),
            Err(error) => self.fail(format!("no thread for opening the file: {error}")),
        }
    }

    pub(super) fn make_picture(&mut self, ctx: &Context, request: PictureRequest) {
        let Some(surroundings) = self.surroundings.clone() else {
            self.fail(
                "the environment is still loading; save the picture when it is there".to_owned(),
            );
            return;
        };
        let (id, wake, gpu) = (self.job_id(), ctx.clone(), self.gpu.clone());
        let (state, what) = (self.state.clone(), request.clone());
        let job = Job::start(
            id,
            "drawing the picture".to_owned(),
            move || wake.request_repaint(),
            move |progress| picture::make(&gpu, &state, surroundings, &what, progress),
        );
        match job {
            Ok(job) => self.pictures.push((request, job)),
            Err(error) => self.fail(format!("no thread for drawing the picture: {error}")),
        }
    }

    /// Opens a dialog of the system on a thread of its own.
    pub(super) fn ask(&mut self, ctx: &Context, dialog: Dialog) {
        let (id, wake, kind) = (self.job_id(), ctx.clone(), dialog.clone());
        let job = Job::start(
            id,
            "file dialog".to_owned(),
            move || wake.request_repaint(),
            move |_| files::ask(&kind),
        );
        match job {
            Ok(job) => self.asked = Some((dialog, job)),
            Err(error) => self.fail(format!("no thread for the file dialog: {error}")),
        }
    }

    pub(super) fn cancel(&mut self, id: u64) {
        self.loading.take_if(|job| job.id == id);
        self.opening.take_if(|job| job.id == id);
        self.pictures.retain(|(_, job)| job.id != id);
    }

    pub(super) fn poll_jobs(&mut self, ctx: &Context) {
        self.poll_loading();
        self.poll_opening(ctx);
        self.poll_pictures(ctx);
        self.poll_asked(ctx);
    }

    fn poll_loading(&mut self) {
        let Some(job) = self.loading.take() else {
            return;
        };
        match job.poll() {
            Outcome::Running => self.loading = Some(job),
            Outcome::Done(Ok(ready)) => {
                let Surroundings {
                    environment,
                    loaded,
                } = &ready.surroundings;
                // Of the built-in ones it stands beside their name; of a file it is news.
                if let (Environment::File(_), Some(summary)) = (environment, loaded.bad.summary()) {
                    self.tell(format!("{}: {summary}", environment.name()));
                }
                self.install(ready);
            }
            Outcome::Done(Err(why)) => self.loading_failed(why),
            Outcome::Failed => {
                self.loading_failed("opening the environment ended without a result".to_owned());
            }
        }
    }

    /// A bad file leaves the scene as it was; a scene whose environment is missing gets the default one.
    fn loading_failed(&mut self, why: String) {
        self.fail(why);
        match &self.surroundings {
            Some(shown) => self.state.environment = shown.environment.clone(),
            None => {
                self.is_bare = self.state.environment == Environment::default();
                self.state.environment = Environment::default();
            }
        }
    }

    pub(super) fn install(&mut self, ready: Ready) {
        self.renderer.install_environment(ready.texture);
        let environment = &ready.surroundings.environment;
        if self.state.environment != *environment {
            self.act(Action::SetEnvironment(environment.clone()));
        }
        self.surroundings = Some(ready.surroundings);
    }

    fn poll_opening(&mut self, ctx: &Context) {
        let Some(job) = self.opening.take() else {
            return;
        };
        match job.poll() {
            Outcome::Running => self.opening = Some(job),
            Outcome::Done(Ok(Opened::Scene(state))) => {
                self.history
                    .record(&self.state, &Action::Load(state.clone()));
                self.replace(ctx, state.sanitized());
                self.tree = panes::tree_of(&self.state);
            }
            Outcome::Done(Ok(Opened::Environment(environment))) => self.load(ctx, environment),
            Outcome::Done(Err(why)) => self.fail(why),
            Outcome::Failed => self.fail("reading the file ended without a result".to_owned()),
        }
    }

    fn poll_pictures(&mut self, ctx: &Context) {
        for (request, job) in std::mem::take(&mut self.pictures) {
            match job.poll() {
                Outcome::Running => self.pictures.push((request, job)),
                Outcome::Done(Ok(picture)) => match request.to {
                    Destination::File { path, .. } => {
                        self.tell(format!("The picture is in {}", path.display()));
                    }
                    Destination::Clipboard => {
                        ctx.copy_image(picture.to_color_image());
                        self.tell("The picture is on the clipboard".to_owned());
                    }
                },
                Outcome::Done(Err(why)) => self.fail(why),
                Outcome::Failed => {
                    self.fail("drawing the picture ended without a result".to_owned());
                }
            }
        }
    }

    fn poll_asked(&mut self, ctx: &Context) {
        let Some((dialog, job)) = self.asked.take() else {
            return;
        };
        let path = match job.poll() {
            Outcome::Running => {
                self.asked = Some((dialog, job));
                return;
            }
            Outcome::Done(path) => path,
            Outcome::Failed => None,
        };
        let text = path.as_deref().map(|p| p.display().to_string());
        match (dialog, path) {
            (Dialog::Open(_), Some(path)) => {
                self.dialog = None;
                self.open(ctx, path);
            }
            // Without a dialog of the system the path can still be typed.
            (Dialog::Open(_), None) => self.dialog = Some(Dialog::Open(String::new())),
            (Dialog::SaveScene(_), path) => {
                self.dialog = Some(Dialog::SaveScene(text.unwrap_or_default()));
                drop(path);
            }
            (Dialog::Picture(mut fields), _) => {
                fields.path = text.unwrap_or(fields.path);
                self.dialog = Some(Dialog::Picture(fields));
            }
        }
    }
}
