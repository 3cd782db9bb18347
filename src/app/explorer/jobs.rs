//! The explorer's jobs: what takes longer than a frame, and what becomes of it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::Context;

use super::Explorer;
use crate::app::action::Action;
use crate::app::arrangement::Arrangement;
use crate::app::dialogs::{Dialog, ball_from};
use crate::app::export::Export;
use crate::app::files::{self, Opened};
use crate::app::job::{Job, Outcome};
use crate::app::line_art;
use crate::app::model::{JobLine, Surroundings};
use crate::app::object::{BodyKey, Jobs, News, job_line};
use crate::app::picture::{self, Destination, PictureRequest};
use crate::app::reading::{Reading, Refusal, surroundings};
use crate::app::state::AppState;
use crate::gpu::{EnvironmentSource, EnvironmentTexture, Gpu};
use crate::imaging::atomic::write_atomically;
use crate::imaging::{Environment, MapFile, Pictures, Progress, short_name};
use crate::optics::material::BallPicture;

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

/// What an errand leaves behind.
#[derive(Default)]
pub(super) struct Errand {
    /// For the user.
    pub(super) message: String,
    /// For the clipboard.
    pub(super) picture: Option<egui::ColorImage>,
    /// Texels a second that were exported.
    pub(super) rate: Option<f64>,
}

/// Writes a scene as text.
pub(super) fn write_scene(scene: &AppState, path: &Path, force: bool) -> Result<(), String> {
    let text = scene.to_json().map_err(|error| error.to_string())?;
    write_atomically(path, force, text.as_bytes()).map_err(|error| error.to_string())
}

impl Explorer {
    /// The jobs under way.
    pub fn jobs(&self) -> Vec<JobLine> {
        let loading = self.loading.iter().map(job_line);
        let opening = self.opening.iter().map(job_line);
        let reading = self.reading.iter().filter_map(Reading::job);
        loading
            .chain(opening)
            .chain(reading)
            .chain(self.errands.iter().map(job_line))
            .chain(self.object.jobs())
            .chain(self.labs.jobs())
            .collect()
    }

    pub(super) fn job_id(&mut self) -> u64 {
        self.next_job += 1;
        self.next_job
    }

    /// Starts loading surroundings; an older load is cancelled.
    pub(super) fn load(&mut self, ctx: &Context, environment: Environment) {
        self.load_from(ctx, environment, None);
    }

    /// The same of a file that may have been decoded already.
    pub(super) fn load_from(
        &mut self,
        ctx: &Context,
        environment: Environment,
        decoded: Option<Arc<Pictures>>,
    ) {
        let (id, wake, gpu) = (self.job_id(), ctx.clone(), self.gpu.clone());
        let title = format!("opening {}", environment.name());
        let job = Job::start(
            id,
            title,
            move || wake.request_repaint(),
            move |progress| {
                let (loaded, how) = match &environment {
                    Environment::File(file) => {
                        let (loaded, how) = surroundings(file, decoded, progress)?;
                        (loaded, Some(how))
                    }
                    built_in => (built_in.image(progress)?, None),
                };
                if progress.is_cancelled() {
                    return Err(Refusal::Failed("opening was cancelled".to_owned()));
                }
                let surroundings = Surroundings {
                    environment,
                    loaded: Arc::new(loaded),
                };
                let ready = Ready::new(&gpu, surroundings).map_err(Refusal::Failed)?;
                Ok((ready, how))
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
        let at = |path: &Path| Errand {
            message: format!("The picture is in {}", path.display()),
            ..Errand::default()
        };
        let Some(surroundings) = self.surroundings.clone() else {
            let why = "the environment is still loading; save the picture when it is there";
            self.fail(why.to_owned());
            return;
        };
        let (gpu, scene) = (self.gpu.clone(), self.scene());
        let measured = self.labs.bench.measured().cloned();
        self.send(ctx, "drawing the picture", move |progress| {
            if let (Some(written), Destination::File { path, .. }) =
                (line_art::written(&scene, &request), &request.to)
            {
                return written.map(|()| at(path));
            }
            let made = picture::make_with(&gpu, &scene, surroundings, measured, &request, progress);
            let picture = made?;
            Ok(match request.to {
                Destination::File { path, .. } => at(&path),
                Destination::Clipboard => Errand {
                    message: "The picture was sent to the clipboard".to_owned(),
                    picture: Some(picture.to_color_image()),
                    rate: None,
                },
            })
        });
    }

    /// Writes the environment for another program.
    pub(super) fn export(&mut self, ctx: &Context, export: Export) {
        let Some(shown) = &self.surroundings else {
            self.fail("the environment is still loading; export it when it is there".to_owned());
            return;
        };
        let environment = shown.environment.clone();
        // Replacing is allowed once, for the file that was asked about.
        self.last_export = Export {
            force: false,
            ..export.clone()
        };
        self.send(ctx, "exporting the environment", move |progress| {
            let start = std::time::Instant::now();
            export.write(&environment, progress)?;
            Ok(Errand {
                message: format!(
                    "The environment is in {}",
                    files::absolute(Path::new(&export.path)).display()
                ),
                rate: Some(export.texels() as f64 / start.elapsed().as_secs_f64()),
                ..Errand::default()
            })
        });
    }

    pub(super) fn save_scene(&mut self, ctx: &Context, path: PathBuf, force: bool) {
        let scene = self.scene();
        self.send(ctx, "saving the scene", move |_| {
            write_scene(&scene, &path, force)?;
            let message = format!("The scene is in {}", path.display());
            Ok(Errand {
                message,
                ..Errand::default()
            })
        });
    }

    /// Starts a job that ends in a message.
    pub(super) fn send(
        &mut self,
        ctx: &Context,
        title: &str,
        work: impl FnOnce(&Progress) -> Result<Errand, String> + Send + 'static,
    ) {
        let (id, wake) = (self.job_id(), ctx.clone());
        match Job::start(id, title.to_owned(), move || wake.request_repaint(), work) {
            Ok(job) => self.errands.push(job),
            Err(error) => self.fail(format!("no thread for {title}: {error}")),
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
        if self.loading.take_if(|job| job.id == id).is_some() {
            self.keep_shown();
        }
        self.object.cancel(id);
        self.labs.cancel(id);
        self.opening.take_if(|job| job.id == id);
        let is_reading = |reading: &Reading| reading.job().is_some_and(|job| job.id == id);
        if self.reading.as_ref().is_some_and(is_reading) {
            (self.reading, self.dialog) = (None, None);
        }
        self.errands.retain(|job| job.id != id);
    }

    pub(super) fn poll_jobs(&mut self, ctx: &Context) {
        self.poll_loading();
        self.poll_opening(ctx);
        self.poll_errands(ctx);
        self.poll_asked(ctx);
        self.labs.poll(ctx);
        self.paces.poll();
        self.follow_reading(ctx);
        for news in self.object.poll() {
            match news {
                News::Opened(path) => self.act(Action::SetModel(path)),
                News::BodyFailed(why) => {
                    self.fail(why);
                    self.keep_body();
                }
                News::BallFailed(picture, why) => {
                    self.fail(why);
                    let materials = std::iter::once(&mut self.state.material)
                        .chain(&mut self.state.compare_material);
                    for material in materials.filter(|m| m.ball == picture) {
                        material.ball = BallPicture::default();
                    }
                }
                News::PathsFailed(why) => self.fail(why),
                News::Note(note) => self.tell(note),
            }
        }
    }

    /// Measures how fast the export of the open dialog will be.
    pub(super) fn measure_pace(&mut self, ctx: &Context) {
        let wanted = match (&self.dialog, &self.surroundings) {
            (Some(Dialog::Export(export)), Some(shown)) => Some((&**export, &shown.loaded)),
            _ => None,
        };
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        if let Err(why) = self.paces.follow(wanted, &mut jobs) {
            self.fail(why);
        }
    }

    /// The state names the body that is shown.
    fn keep_body(&mut self) {
        match self.object.key() {
            BodyKey::Model(path) => self.state.model = Some(path.clone()),
            BodyKey::BuiltIn(object, density) => {
                self.state.model = None;
                (self.state.object, self.state.density) = (*object, *density);
            }
        }
        // The ray met another body.
        self.state.eye_ray = None;
    }

    /// Opens a model in a job; the state changes when it is there.
    pub(super) fn open_model(&mut self, ctx: &Context, path: PathBuf) {
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        if let Err(why) = self.object.open_model(&mut jobs, &self.state, path) {
            self.fail(why);
        }
    }

    fn poll_loading(&mut self) {
        let Some(job) = self.loading.take() else {
            return;
        };
        match job.poll() {
            Outcome::Running => self.loading = Some(job),
            Outcome::Done(Ok((ready, how))) => {
                let Surroundings {
                    environment,
                    loaded,
                } = &ready.surroundings;
                // What is wrong with a built-in one stands beside its name; of a file it is news, as is how it was read.
                if let Some(how) = how {
                    let parts = std::iter::once(how).chain(loaded.bad.summary());
                    let text = parts.collect::<Vec<String>>().join("; ");
                    self.tell(format!("{}: {text}", environment.name()));
                }
                self.install(ready);
            }
            Outcome::Done(Err(Refusal::Failed(why))) => self.loading_failed(why),
            Outcome::Done(Err(Refusal::Unsure(file, pictures))) => {
                self.keep_shown();
                self.decide(file, pictures);
            }
            Outcome::Failed => {
                self.loading_failed("opening the environment ended without a result".to_owned());
            }
        }
    }

    /// Asks how a file is to be read. What the user does in another dialog is not taken away.
    fn decide(&mut self, file: MapFile, pictures: Arc<Pictures>) {
        if self.dialog.is_some() {
            let name = short_name(&file.path);
            self.fail(format!(
                "it is not certain how {name} is to be read; open it again to say it"
            ));
            return;
        }
        self.reading = Some(Reading::new(file.path.clone(), Some(pictures)));
        self.dialog = Some(Dialog::Reading(file));
    }

    /// The file of the dialog that is shown, if it is about one, is read as it says.
    fn follow_reading(&mut self, ctx: &Context) {
        let Some(Dialog::Reading(file)) = &mut self.dialog else {
            self.reading = None;
            return;
        };
        let other = self.reading.take().filter(|reading| reading.is_of(file));
        let reading = other.unwrap_or_else(|| Reading::new(file.path.clone(), None));
        let reading = self.reading.insert(reading);
        let mut jobs = Jobs {
            last_id: &mut self.next_job,
            ctx,
        };
        reading.follow(file, &mut jobs);
    }

    /// A bad file leaves the scene as it was; a scene whose environment is missing gets the default one.
    fn loading_failed(&mut self, why: String) {
        self.fail(why);
        self.keep_shown();
    }

    /// The state names the surroundings that are shown. Before the first ones it names the default, unless just that did
    /// not come.
    fn keep_shown(&mut self) {
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
            Outcome::Done(Ok(Opened::Scene(state))) => self.show_scene(ctx, *state),
            Outcome::Done(Ok(Opened::Environment(environment))) => self.load(ctx, environment),
            Outcome::Done(Ok(Opened::Model(path))) => self.open_model(ctx, path),
            Outcome::Done(Err(why)) => self.fail(why),
            Outcome::Failed => self.fail("reading the file ended without a result".to_owned()),
        }
    }

    /// Shows another scene, which can be taken back.
    pub(super) fn show_scene(&mut self, ctx: &Context, scene: AppState) {
        // With the panes as they lie, so that undo puts them back.
        self.state.arrangement = Arrangement::of_tree(&self.tree);
        let before = self.state.clone();
        self.replace(ctx, scene.clone().sanitized());
        self.history.record(before, &Action::Load(Box::new(scene)));
    }

    fn poll_errands(&mut self, ctx: &Context) {
        for job in std::mem::take(&mut self.errands) {
            match job.poll() {
                Outcome::Running => self.errands.push(job),
                Outcome::Done(Ok(Errand {
                    message,
                    picture,
                    rate,
                })) => {
                    if let Some(rate) = rate {
                        self.paces.learn(rate);
                    }
                    if let Some(picture) = picture {
                        ctx.copy_image(picture);
                    }
                    self.tell(message);
                }
                Outcome::Done(Err(why)) => self.fail(why),
                Outcome::Failed => self.fail(format!("{} ended without a result", job.title)),
            }
        }
    }

    fn poll_asked(&mut self, ctx: &Context) {
        let Some((dialog, job)) = self.asked.take() else {
            return;
        };
        match job.poll() {
            Outcome::Running => self.asked = Some((dialog, job)),
            Outcome::Done(Some(path)) if matches!(dialog, Dialog::Open(_)) => {
                self.dialog = None;
                self.open(ctx, path);
            }
            Outcome::Done(Some(path)) if matches!(dialog, Dialog::OpenBall(_)) => {
                self.dialog = None;
                self.act(ball_from(&self.state.material, path));
            }
            Outcome::Done(Some(path)) => self.dialog = Some(dialog.with_chosen(&path)),
            // Declined, or there is no dialog of the system: what was typed stays.
            Outcome::Done(None) | Outcome::Failed => {}
        }
    }
}
