//! The object on the stage: its body, its materials' pictures and the paths through it. All that takes time is a job.

mod paths;

use std::path::PathBuf;

use super::job::{Job, Outcome};
use super::model::JobLine;
use super::objects::target_of;
use super::state::{AppState, DENSITY_RANGE};
use crate::gpu::{Body, ObjectFrame, Shared};
use crate::imaging::ball::{self, BallPixels, Style};
use crate::imaging::{Progress, Stage, short_name};
use crate::meshes;
use crate::optics::Material;
use crate::optics::material::{BallPicture, Surface, View};
use crate::scene::trace::Traced;
use crate::scene::{Object, Target};

use paths::PathsKey;

/// Which body.
#[derive(Clone, Debug, PartialEq)]
pub enum BodyKey {
    /// A built-in object and the fineness of its triangles.
    BuiltIn(Object, u32),
    /// A model from a file.
    Model(PathBuf),
}

impl BodyKey {
    /// The body that the state names.
    pub fn of(state: &AppState) -> Self {
        match &state.model {
            Some(path) => Self::Model(path.clone()),
            None => Self::BuiltIn(state.object, state.density),
        }
    }

    /// Makes the body, and tells what there is to say about it.
    fn make(&self, progress: &Progress) -> Result<(Body, Vec<String>), String> {
        match self {
            Self::BuiltIn(object, _) if self.is_at_hand() => Ok((built_in(*object), Vec::new())),
            Self::BuiltIn(object, density) => {
                let target = Shared::new(Target::new(object.mesh_at(*density)));
                // Only the fine sphere stands for the ball.
                let is_ball = false;
                Ok((Body { target, is_ball }, Vec::new()))
            }
            Self::Model(path) => {
                let loaded = meshes::load(path, progress).map_err(|error| error.to_string())?;
                let target = Shared::new(Target::new(loaded.mesh));
                let is_ball = false;
                Ok((Body { target, is_ball }, loaded.notes))
            }
        }
    }

    /// True when it takes no time to make.
    fn is_at_hand(&self) -> bool {
        matches!(self, Self::BuiltIn(_, density) if *density == DENSITY_RANGE.1)
    }

    fn name(&self) -> String {
        match self {
            Self::BuiltIn(object, _) => object.name().to_owned(),
            Self::Model(path) => short_name(path),
        }
    }
}

fn built_in(object: Object) -> Body {
    Body {
        target: target_of(object).into(),
        is_ball: object == Object::Sphere,
    }
}

/// What a frame shows of the object.
#[derive(Clone, Debug)]
pub struct ObjectFrames {
    /// The body.
    pub body: Body,
    /// Left of the divider.
    pub left: ObjectFrame,
    /// Right of it, if it is of something else.
    pub right: Option<ObjectFrame>,
}

/// What there is to say of a trace that ended without paths.
const NO_PATHS: &str =
    "tracing ended without a result: there may be too little memory; make the picture smaller";

/// What became of a job, for the user.
pub enum News {
    /// A model that was opened is there.
    Opened(PathBuf),
    /// The state names what cannot be had: it must name what is shown.
    BodyFailed(String),
    /// A picture could not be opened: the state must name another.
    BallFailed(BallPicture, String),
    /// The view could not be traced.
    PathsFailed(String),
    /// Something to tell.
    Note(String),
}

/// The results of what takes time, and the jobs that bring them.
pub struct ObjectData {
    key: BodyKey,
    body: Body,
    building: Option<Building>,
    balls: Vec<(BallPicture, Shared<BallPixels>)>,
    opening: Option<(BallPicture, Job<Result<BallPixels, String>>)>,
    paths: Vec<(PathsKey, Shared<Traced>)>,
    tracing: Option<(PathsKey, Job<Option<Traced>>)>,
    /// Not tried again while they are wanted: cancelled, or there was no memory.
    given_up: Vec<PathsKey>,
    /// Of what the user has stopped.
    cancelled: Vec<News>,
    /// Why the view's paths are refused, once it has been told.
    refused: Option<String>,
}

struct Building {
    key: BodyKey,
    /// It was opened by the user over this body: the state follows when it is there.
    opened_over: Option<BodyKey>,
    job: Job<Result<(Body, Vec<String>), String>>,
}

/// Where jobs get their numbers, and what they wake.
pub struct Jobs<'a> {
    /// The last number given.
    pub last_id: &'a mut u64,
    /// The window.
    pub ctx: &'a egui::Context,
}

impl Jobs<'_> {
    /// Starts `work` on a thread of its own.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn start<T: Send + 'static>(
        &mut self,
        title: String,
        work: impl FnOnce(&Progress) -> T + Send + 'static,
    ) -> Result<Job<T>, String> {
        *self.last_id += 1;
        let wake = self.ctx.clone();
        let failed = format!("no thread for {title}");
        Job::start(*self.last_id, title, move || wake.request_repaint(), work)
            .map_err(|error| format!("{failed}: {error}"))
    }
}

impl ObjectData {
    /// The built-in object of a state; whatever else it names comes by jobs.
    pub fn new(state: &AppState) -> Self {
        Self {
            key: BodyKey::BuiltIn(state.object, DENSITY_RANGE.1),
            body: built_in(state.object),
            building: None,
            balls: Vec::new(),
            opening: None,
            paths: Vec::new(),
            tracing: None,
            given_up: Vec::new(),
            cancelled: Vec::new(),
            refused: None,
        }
    }

    /// The body that is shown, prepared for rays.
    pub fn target(&self) -> &Target {
        &self.body.target
    }

    /// The same, to be kept by a job.
    pub fn shared_target(&self) -> Shared<Target> {
        self.body.target.clone()
    }

    /// True when the body stands for the unit ball.
    pub fn is_ball(&self) -> bool {
        self.body.is_ball
    }

    /// The body that is shown.
    pub fn key(&self) -> &BodyKey {
        &self.key
    }

    /// Opens a model over what the state names.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn open_model(
        &mut self,
        jobs: &mut Jobs<'_>,
        state: &AppState,
        path: PathBuf,
    ) -> Result<(), String> {
        self.build(jobs, BodyKey::Model(path), Some(BodyKey::of(state)))
    }

    fn build(
        &mut self,
        jobs: &mut Jobs<'_>,
        key: BodyKey,
        opened_over: Option<BodyKey>,
    ) -> Result<(), String> {
        let made = key.clone();
        let job = jobs.start(format!("opening {}", key.name()), move |progress| {
            made.make(progress)
        })?;
        self.building = Some(Building {
            key,
            opened_over,
            job,
        });
        Ok(())
    }

    /// Starts what the state needs and what is not there; drops what it does not need. `size_px` is the viewport's.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn follow(
        &mut self,
        state: &AppState,
        size_px: Option<[u32; 2]>,
        jobs: &mut Jobs<'_>,
    ) -> Result<(), String> {
        let wanted = BodyKey::of(state);
        if self.key != wanted && wanted.is_at_hand() {
            // Nothing can fail here.
            if let Ok((body, _)) = wanted.make(&Progress::new()) {
                (self.key, self.body) = (wanted.clone(), body);
            }
        }
        // A model that is being opened gives way to whatever was chosen after it.
        self.building
            .take_if(|building| match &building.opened_over {
                Some(over) => *over != wanted,
                None => building.key != wanted || self.key == wanted,
            });
        if self.key != wanted && self.building.is_none() {
            self.build(jobs, wanted, None)?;
        }
        self.follow_balls(state, jobs)?;
        self.follow_paths(state, size_px, jobs)
    }

    fn follow_balls(&mut self, state: &AppState, jobs: &mut Jobs<'_>) -> Result<(), String> {
        let wanted: Vec<BallPicture> = state.materials().filter_map(ball_of).cloned().collect();
        self.balls.retain(|(picture, _)| wanted.contains(picture));
        self.opening
            .take_if(|(picture, _)| !wanted.contains(picture));
        for picture in wanted {
            let is_there = self.balls.iter().any(|(held, _)| *held == picture);
            if is_there || self.opening.is_some() {
                continue;
            }
            let made = picture.clone();
            let title = "opening the ball's picture".to_owned();
            let job = jobs.start(title, move |progress| open_ball(&made, progress))?;
            self.opening = Some((picture, job));
        }
        Ok(())
    }

    fn follow_paths(
        &mut self,
        state: &AppState,
        size_px: Option<[u32; 2]>,
        jobs: &mut Jobs<'_>,
    ) -> Result<(), String> {
        let mut wanted = self.wanted_paths(state, size_px);
        let refused = PathsKey::refused(&wanted);
        if refused.is_some() {
            wanted.clear();
        }
        self.paths.retain(|(key, _)| wanted.contains(key));
        self.given_up.retain(|key| wanted.contains(key));
        self.tracing.take_if(|(key, _)| !wanted.contains(key));
        if self.refused != refused {
            self.refused.clone_from(&refused);
            // Told once; one surface is shown.
            return refused.map_or(Ok(()), Err);
        }
        let missing = wanted
            .into_iter()
            .filter(|key| !self.given_up.contains(key))
            .find(|key| self.paths.iter().all(|(held, _)| held != key));
        if let Some(key) = missing.filter(|_| self.tracing.is_none()) {
            let made = key.clone();
            let title = "tracing through the body".to_owned();
            let job = jobs.start(title, move |progress| made.trace(progress))?;
            self.tracing = Some((key, job));
        }
        Ok(())
    }

    fn wanted_paths(&self, state: &AppState, size_px: Option<[u32; 2]>) -> Vec<PathsKey> {
        let Some(size_px) = size_px.filter(|_| !self.body.is_ball) else {
            return Vec::new();
        };
        let through = state.materials().filter(|material| material.is_through());
        through
            .map(|material| self.paths_key(state, material, size_px))
            .collect()
    }

    fn paths_key(&self, state: &AppState, material: &Material, size_px: [u32; 2]) -> PathsKey {
        PathsKey {
            target: self.body.target.clone(),
            camera: state.camera,
            size_px,
            eta: material.eta(),
            bounces: material.bounces,
        }
    }

    /// Waits for everything that the state needs: for pictures.
    ///
    /// # Errors
    /// One line that says what cannot be had.
    pub fn complete(&mut self, state: &AppState, size_px: Option<[u32; 2]>) -> Result<(), String> {
        let progress = Progress::new();
        let wanted = BodyKey::of(state);
        if self.key != wanted {
            let (body, _) = wanted.make(&progress)?;
            (self.key, self.body) = (wanted, body);
        }
        for picture in state.materials().filter_map(ball_of) {
            if self.balls.iter().all(|(held, _)| held != picture) {
                let image = open_ball(picture, &progress)?;
                self.balls.push((picture.clone(), Shared::new(image)));
            }
        }
        let wanted = self.wanted_paths(state, size_px);
        if let Some(why) = PathsKey::refused(&wanted) {
            return Err(why);
        }
        for key in wanted {
            if self.paths.iter().all(|(held, _)| *held != key) {
                let traced = key.trace(&progress).ok_or(NO_PATHS)?;
                self.paths.push((key, Shared::new(traced)));
            }
        }
        Ok(())
    }

    /// Takes in what the jobs have brought.
    pub fn poll(&mut self) -> Vec<News> {
        let mut news = std::mem::take(&mut self.cancelled);
        if let Some(building) = self.building.take() {
            match building.job.poll() {
                Outcome::Running => self.building = Some(building),
                Outcome::Done(Ok((body, notes))) => {
                    (self.key, self.body) = (building.key.clone(), body);
                    let name = self.key.name();
                    if let (Some(_), BodyKey::Model(path)) = (building.opened_over, building.key) {
                        news.push(News::Opened(path));
                    }
                    if !notes.is_empty() {
                        news.push(News::Note(format!("{name}: {}", notes.join("; "))));
                    }
                }
                Outcome::Done(Err(why)) => news.push(News::BodyFailed(why)),
                Outcome::Failed => {
                    let why = "opening the model ended without a result".to_owned();
                    news.push(News::BodyFailed(why));
                }
            }
        }
        if let Some((picture, job)) = self.opening.take() {
            match job.poll() {
                Outcome::Running => self.opening = Some((picture, job)),
                Outcome::Done(Ok(image)) => self.balls.push((picture, Shared::new(image))),
                Outcome::Done(Err(why)) => {
                    news.push(News::BallFailed(picture, why));
                }
                Outcome::Failed => {
                    let why = "opening the picture ended without a result".to_owned();
                    news.push(News::BallFailed(picture, why));
                }
            }
        }
        if let Some((key, job)) = self.tracing.take() {
            match job.poll() {
                Outcome::Running => self.tracing = Some((key, job)),
                Outcome::Done(Some(traced)) => self.paths.push((key, Shared::new(traced))),
                // One surface is shown, and it is not tried again in this view.
                Outcome::Done(None) | Outcome::Failed => {
                    news.push(News::PathsFailed(NO_PATHS.to_owned()));
                    self.given_up.push(key);
                }
            }
        }
        news
    }

    /// True while a job runs.
    pub fn is_busy(&self) -> bool {
        self.building.is_some() || self.opening.is_some() || self.tracing.is_some()
    }

    /// The jobs under way that the user may want to see.
    pub fn jobs(&self) -> impl Iterator<Item = JobLine> {
        let building = self.building.iter().map(|b| job_line(&b.job));
        let opening = self.opening.iter().map(|(_, job)| job_line(job));
        let tracing = self.tracing.iter().map(|(_, job)| job_line(job));
        building.chain(opening).chain(tracing)
    }

    /// Stops a job; what it leaves to be done comes with the next news.
    pub fn cancel(&mut self, id: u64) {
        if let Some((picture, _)) = self.opening.take_if(|(_, job)| job.id == id) {
            let why = "opening the picture was cancelled".to_owned();
            self.cancelled.push(News::BallFailed(picture, why));
        }
        if self.building.take_if(|b| b.job.id == id).is_some() {
            let why = "opening the model was cancelled".to_owned();
            self.cancelled.push(News::BodyFailed(why));
        }
        if let Some((key, _)) = self.tracing.take_if(|(_, job)| job.id == id) {
            self.given_up.push(key);
        }
    }

    /// What a frame shows. The viewport has `size_px` pixels.
    pub fn frames(&self, state: &AppState, size_px: Option<[u32; 2]>) -> ObjectFrames {
        let side = |material: &Material| ObjectFrame {
            ball: ball_of(material).and_then(|picture| {
                let held = self.balls.iter().find(|(held, _)| held == picture);
                held.map(|(_, image)| image.clone())
            }),
            traced: size_px.and_then(|size_px| {
                let key = self.paths_key(state, material, size_px);
                let held = self.paths.iter().find(|(held, _)| *held == key);
                held.map(|(_, traced)| traced.clone())
            }),
            material: material.clone(),
        };
        ObjectFrames {
            body: self.body.clone(),
            left: side(&state.material),
            right: state.compare_material.as_ref().map(side),
        }
    }
}

/// The line of a job.
pub fn job_line<T: Send + 'static>(job: &Job<T>) -> JobLine {
    let stage = job.progress.stage();
    let title = match stage {
        Stage::Waiting | Stage::Done => job.title.clone(),
        _ => format!("{}: {}", job.title, stage.name()),
    };
    JobLine {
        id: job.id,
        title,
        fraction: job.progress.fraction(),
        left: job.progress.left(),
    }
}

/// The picture that a material shows.
fn ball_of(material: &Material) -> Option<&BallPicture> {
    let is_shown = material.surface == Surface::Ball && material.view == View::Whole;
    is_shown.then_some(&material.ball)
}

fn open_ball(picture: &BallPicture, progress: &Progress) -> Result<BallPixels, String> {
    Ok(match picture {
        BallPicture::Outline => Style::Outline.pixels(),
        BallPicture::Toon => Style::Toon.pixels(),
        BallPicture::Studio => Style::Studio.pixels(),
        BallPicture::File(path) => ball::open(path, progress).map_err(|error| error.to_string())?,
    })
}
