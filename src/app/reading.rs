//! How a file is read: decoded once, then taken and looked at in another way whenever something else is said of it.

use std::path::PathBuf;
use std::sync::Arc;

use egui::{ColorImage, Context, TextureHandle, TextureOptions};

use super::job::{Job, Outcome};
use super::model::JobLine;
use super::object::{Jobs, job_line};
use crate::imaging::detect::Proposal;
use crate::imaging::load::{LoadError, LoadProblem};
use crate::imaging::solver::Solution;
use crate::imaging::{
    Loaded, MapFile, OpenHints, OpenedMap, Pictures, Preview, Progress, Raster, Samples,
};

/// Why there are no surroundings.
pub enum Refusal {
    /// They do not open.
    Failed(String),
    /// The user has to say what the file is.
    Unsure(MapFile, Arc<Pictures>),
}

impl From<LoadError> for Refusal {
    fn from(error: LoadError) -> Self {
        Self::Failed(error.to_string())
    }
}

/// The surroundings in a file, and how they were read. Pictures that were decoded before are not decoded again.
///
/// # Errors
/// When the file does not open, or nothing was said of it and it is not certain what it is.
pub fn surroundings(
    file: &MapFile,
    decoded: Option<Arc<Pictures>>,
    progress: &Progress,
) -> Result<(Loaded, String), Refusal> {
    let pictures = decode(file, decoded, progress)?;
    match pictures.taken(&file.hints) {
        Ok(opened) if opened.is_sure() || !file.hints.is_empty() => {
            let sentence = opened.sentence();
            Ok((opened.into_latlong(progress)?, sentence))
        }
        Err(error) if !matches!(error.problem, LoadProblem::Untold(_)) => Err(error.into()),
        _ => Err(Refusal::Unsure(file.clone(), pictures)),
    }
}

fn decode(
    file: &MapFile,
    decoded: Option<Arc<Pictures>>,
    progress: &Progress,
) -> Result<Arc<Pictures>, LoadError> {
    let paths = std::slice::from_ref(&file.path);
    match decoded.filter(|pictures| pictures.are_of(paths, &file.hints)) {
        Some(pictures) => Ok(pictures),
        None => Pictures::read(paths, &file.hints, progress).map(Arc::new),
    }
}

/// A map's pictures on the screen.
pub struct Shown {
    /// The six faces as a cross.
    pub cross: TextureHandle,
    /// The mirroring ball.
    pub ball: TextureHandle,
}

/// The map as it would be taken.
pub struct Taken {
    /// As what.
    pub chosen: Proposal,
    /// What the user should know, a sentence each.
    pub notes: Vec<String>,
    /// How its faces would meet, when they do not as they are labelled.
    pub misfit: Option<Solution>,
    /// How it looks.
    pub shown: Shown,
}

/// What a job finds.
struct Found {
    pictures: Arc<Pictures>,
    labelled: Option<Preview>,
    taken: Result<(OpenedMap, Preview), String>,
}

/// A file that the user is deciding about. Dropped, it cancels its job and forgets the pictures.
pub struct Reading {
    path: PathBuf,
    /// What was said of the file when the last job was started.
    asked: Option<OpenHints>,
    job: Option<Job<Result<Found, String>>>,
    pictures: Option<Arc<Pictures>>,
    labelled: Option<Shown>,
    taken: Option<Result<Taken, String>>,
}

impl Reading {
    /// A file that is not looked at yet, or whose pictures are there.
    pub fn new(path: PathBuf, pictures: Option<Arc<Pictures>>) -> Self {
        Self {
            path,
            asked: None,
            job: None,
            pictures,
            labelled: None,
            taken: None,
        }
    }

    /// Whether it is about this file.
    pub fn is_of(&self, file: &MapFile) -> bool {
        self.path == file.path
    }

    /// What its files hold, once they are decoded.
    pub fn pictures(&self) -> Option<&Arc<Pictures>> {
        self.pictures.as_ref()
    }

    /// The labelled environment, once it is drawn.
    pub fn labelled(&self) -> Option<&Shown> {
        self.labelled.as_ref()
    }

    /// The map as it was taken last, or why it cannot be; `None` before the first time.
    pub fn taken(&self) -> Option<&Result<Taken, String>> {
        self.taken.as_ref()
    }

    /// The job under way.
    pub fn job(&self) -> Option<JobLine> {
        self.job.as_ref().map(job_line)
    }

    /// Takes in what a job has found, and starts the next one when other things are said of the file by now. A running job
    /// is waited for: it may be decoding, which no hint needs anew.
    pub fn follow(&mut self, file: &mut MapFile, jobs: &mut Jobs<'_>) {
        if let Some(job) = self.job.take() {
            match job.poll() {
                Outcome::Running => self.job = Some(job),
                Outcome::Done(Ok(found)) => self.take_in(found, file, jobs.ctx),
                Outcome::Done(Err(why)) => self.taken = Some(Err(why)),
                Outcome::Failed => {
                    let why = "reading the file ended without a result";
                    self.taken = Some(Err(why.to_owned()));
                }
            }
        }
        if self.job.is_some() || self.asked == Some(file.hints) {
            return;
        }
        self.asked = Some(file.hints);
        let (file, decoded) = (file.clone(), self.pictures.clone());
        let wants_labelled = self.labelled.is_none();
        let work = move |progress: &Progress| find(&file, decoded, wants_labelled, progress);
        match jobs.start("reading the environment".to_owned(), work) {
            Ok(job) => self.job = Some(job),
            Err(why) => self.taken = Some(Err(why)),
        }
    }

    fn take_in(&mut self, found: Found, file: &mut MapFile, ctx: &Context) {
        if let Some(preview) = found.labelled {
            self.labelled = Some(shown(ctx, "labelled", &preview));
        }
        // Nothing was said and it cannot be told: the likeliest is shown first.
        if found.taken.is_err()
            && file.hints.is_empty()
            && let Some(likeliest) = found.pictures.proposals().first()
        {
            file.hints = likeliest.hints(&file.hints);
        }
        self.pictures = Some(found.pictures);
        self.taken = Some(found.taken.map(|(opened, preview)| Taken {
            chosen: opened.chosen,
            notes: opened.notes,
            misfit: opened.misfit,
            shown: shown(ctx, "map", &preview),
        }));
    }
}

fn find(
    file: &MapFile,
    decoded: Option<Arc<Pictures>>,
    wants_labelled: bool,
    progress: &Progress,
) -> Result<Found, String> {
    let said = |error: LoadError| error.to_string();
    let pictures = decode(file, decoded, progress).map_err(said)?;
    let labelled = wants_labelled.then(|| Preview::labelled(progress));
    let labelled = labelled.transpose().map_err(said)?;
    // The path stands above the message.
    let taken = pictures.taken(&file.hints);
    let taken = taken.map_err(|error| error.problem.to_string());
    let taken = taken.and_then(|opened| {
        let preview = Preview::of(&opened.map, progress).map_err(|error| error.to_string())?;
        Ok((opened, preview))
    });
    Ok(Found {
        pictures,
        labelled,
        taken,
    })
}

fn shown(ctx: &Context, name: &str, preview: &Preview) -> Shown {
    let texture = |part: &str, picture: &Raster| {
        let codes: &[u8] = match picture.samples() {
            Samples::U8(codes) => codes,
            _ => &[],
        };
        let size = picture.size().map(|side| side as usize);
        let image = if codes.len() == 3 * size[0] * size[1] {
            ColorImage::from_rgb(size, codes)
        } else {
            ColorImage::default()
        };
        ctx.load_texture(format!("{name}: {part}"), image, TextureOptions::LINEAR)
    };
    Shown {
        cross: texture("cross", &preview.cross),
        ball: texture("ball", &preview.ball),
    }
}
