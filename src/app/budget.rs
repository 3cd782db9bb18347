//! Two mappings with as many texels: the object as a mirror before the surroundings, once by each map. What is wanted, the job
//! that makes it, and the pictures.

use std::sync::Arc;

use egui::{Color32, ColorImage, Context, TextureHandle, TextureOptions};

use super::follower::Follower;
use super::labs::Lab;
use super::model::JobLine;
use super::object::Jobs;
use super::state::AppState;
use crate::gpu::{Shared, ToneCurve};
use crate::imaging::{EnvironmentMap, Loaded, Progress};
use crate::lab::equal_budget::{MapSize, Rays};
use crate::math::Rotation;
use crate::scene::{Camera, RayFrame, Target, mirror_view};

/// Most pixels of a picture: a larger one shows each larger.
pub const MOST_PIXELS: u32 = 1 << 19;
/// Most rays of a picture: as many to a pixel as that allows.
const MOST_RAYS: u32 = 1 << 19;
/// Most rays along a pixel's side.
const MOST_PER_SIDE: u32 = 4;

/// Most rays along a pixel's side of what is enlarged: its texels are wider than pixels, those of the surroundings nearly.
const MAGNIFIED_PER_SIDE: u32 = 2;

/// What of the pictures is laid out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Width and height of each picture in pixels.
    pub size: [u32; 2],
    /// What is enlarged.
    pub lens: Option<Lens>,
}

/// A part of the pictures that is enlarged.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lens {
    /// Its middle in the picture, from 0 to 1 each way.
    pub place: [f32; 2],
    /// Width and height of what it shows, over those of the picture.
    pub share: [f32; 2],
    /// Pixels in which it is shown.
    pub size: [u32; 2],
}

/// What the pictures depend on.
#[derive(Clone, Debug, PartialEq)]
pub struct Wanted {
    loaded: Shared<Loaded>,
    rotation: Rotation,
    target: Shared<Target>,
    camera: Camera,
    /// Width and height of each picture in pixels.
    pub size: [u32; 2],
    /// The maps A and B.
    pub maps: [MapSize; 2],
    exposure_ev: f32,
    tone: ToneCurve,
}

impl Wanted {
    /// What the state asks for of these surroundings and this object.
    pub fn new(
        state: &AppState,
        loaded: &Arc<Loaded>,
        target: Shared<Target>,
        size: [u32; 2],
    ) -> Self {
        Self {
            loaded: Arc::clone(loaded).into(),
            rotation: state.rotation,
            target,
            camera: state.camera,
            size,
            maps: compared(state),
            exposure_ev: state.exposure_ev,
            tone: state.tone,
        }
    }

    /// The screen of the pictures.
    fn frame(&self) -> RayFrame {
        let [width, height] = self.size;
        self.camera.ray_frame(width as f32 / height as f32)
    }

    fn has_rays_of(&self, other: &Self) -> bool {
        let view = |wanted: &Self| (wanted.camera, wanted.size);
        self.target == other.target && view(self) == view(other)
    }

    fn has_surroundings_of(&self, other: &Self) -> bool {
        self.loaded == other.loaded && self.rotation == other.rotation
    }

    /// Whether only what is dragged is another: the eye, the number of texels, the exposure.
    fn shows_as(&self, other: &Self) -> bool {
        let maps = |wanted: &Self| wanted.maps.map(|map| map.mapping);
        self.has_surroundings_of(other)
            && (maps(self), self.size, self.tone) == (maps(other), other.size, other.tone)
            && self.target == other.target
    }
}

/// The two maps that the state compares.
pub fn compared(state: &AppState) -> [MapSize; 2] {
    let texels = state.budget.texels;
    state
        .compared_maps()
        .map(|mapping| MapSize::of_budget(mapping, texels))
}

/// As many rays along a pixel's side as all pixels together may have.
fn rays_per_side([width, height]: [u32; 2]) -> u32 {
    let pixels = width.saturating_mul(height).max(1);
    (1..=MOST_PER_SIDE)
        .rev()
        .find(|side| pixels.saturating_mul(side * side) <= MOST_RAYS)
        .unwrap_or(1)
}

/// Linear light of a picture, row by row from the top.
type Light = Arc<Vec<[f32; 3]>>;

/// What is made on the way to the pictures, each part once for as long as it serves.
#[derive(Clone)]
struct Parts {
    source: Arc<EnvironmentMap>,
    rays: Arc<Rays>,
    /// What is seen of the surroundings themselves.
    surroundings: Light,
    maps: [(MapSize, Arc<EnvironmentMap>); 2],
    light: [Light; 2],
}

impl Parts {
    /// Makes them; of earlier ones (`old`) what is the same is kept. `None` when it was cancelled or there is no memory.
    fn of(wanted: &Wanted, old: Option<&(Wanted, Self)>, progress: &Progress) -> Option<Self> {
        let same = |is_same: &dyn Fn(&Wanted) -> bool| {
            let (_, parts) = old.filter(|(of, _)| is_same(of))?;
            Some(parts)
        };
        let source = match same(&|of| of.loaded == wanted.loaded) {
            Some(parts) => Arc::clone(&parts.source),
            None => Arc::new(EnvironmentMap::of_latlong(&wanted.loaded.image).ok()?),
        };
        let rays = match same(&|of| of.has_rays_of(wanted)) {
            Some(parts) => Arc::clone(&parts.rays),
            None => {
                let per_side = rays_per_side(wanted.size);
                let (target, frame) = (&wanted.target, wanted.frame());
                Arc::new(rays(target, &frame, wanted.size, per_side, progress)?)
            }
        };
        let is_seen_so = |of: &Wanted| of.has_rays_of(wanted) && of.has_surroundings_of(wanted);
        let surroundings = match same(&is_seen_so) {
            Some(parts) => Arc::clone(&parts.surroundings),
            None => Arc::new(rays.light(&source, wanted.rotation, progress).ok()?),
        };
        let side = |map: MapSize| {
            let held = same(&|of| of.has_surroundings_of(wanted)).and_then(|parts| {
                parts
                    .maps
                    .iter()
                    .position(|(of, _)| *of == map)
                    .zip(Some(parts))
            });
            let made = match held {
                Some((at, parts)) => Arc::clone(&parts.maps[at].1),
                None => Arc::new(map.map(&source, wanted.rotation, progress).ok()?),
            };
            let light = match held.filter(|(_, parts)| Arc::ptr_eq(&parts.rays, &rays)) {
                Some((at, parts)) => Arc::clone(&parts.light[at]),
                None => Arc::new(rays.light(&made, Rotation::NONE, progress).ok()?),
            };
            Some(((map, made), light))
        };
        let [(a, light_a), (b, light_b)] = [side(wanted.maps[0])?, side(wanted.maps[1])?];
        Some(Self {
            source,
            surroundings,
            maps: [a, b],
            light: [light_a, light_b],
            rays,
        })
    }
}

/// What is seen through `frame` in so many pixels; `None` when cancelled.
fn rays(
    target: &Target,
    frame: &RayFrame,
    size: [u32; 2],
    per_side: u32,
    progress: &Progress,
) -> Option<Rays> {
    let all = size.map(|n| n * per_side);
    let seen = mirror_view(target, frame, all, &|_| progress.is_cancelled())?;
    let rays = seen.iter().map(|s| (s.dir.to_array(), s.is_mirrored));
    Some(Rays {
        size,
        per_side,
        rays: rays.collect(),
    })
}

/// What is on the screen.
pub struct Shown {
    parts: Parts,
    /// The view by the maps A and B, and of the surroundings themselves.
    pub pictures: [TextureHandle; 3],
    /// How far each map is from the surroundings over the object's pixels: root of the mean square in linear light; `None` where
    /// the object is not seen.
    pub rms: [Option<f64>; 2],
}

impl Shown {
    fn of(
        wanted: &Wanted,
        old: Option<&(Wanted, Parts)>,
        ctx: &Context,
        progress: &Progress,
    ) -> Option<Self> {
        let parts = Parts::of(wanted, old, progress)?;
        let [a, b] = &parts.light;
        let picture = |name: &str, light: &Light| {
            // A pixel is seen as it is, also in the magnifier.
            ctx.load_texture(
                name,
                image(light, wanted.size, wanted),
                TextureOptions::NEAREST,
            )
        };
        Some(Self {
            pictures: [
                picture("budget a", a),
                picture("budget b", b),
                picture("budget surroundings", &parts.surroundings),
            ],
            rms: [a, b].map(|light| parts.rays.rms(light, &parts.surroundings)),
            parts,
        })
    }

    /// Linear light of the pictures in the same order, row by row from the top.
    pub fn light(&self) -> [&[[f32; 3]]; 3] {
        let [a, b] = &self.parts.light;
        [a, b, &self.parts.surroundings].map(|light| light.as_slice())
    }
}

fn image(light: &[[f32; 3]], size: [u32; 2], wanted: &Wanted) -> ColorImage {
    let pixel = |light: &[f32; 3]| {
        let shown = wanted.tone.display(*light, wanted.exposure_ev);
        let [r, g, b] = shown.map(|c| (c * 255.0).round() as u8);
        Color32::from_rgb(r, g, b)
    };
    let size = size.map(|n| n as usize);
    ColorImage::new(size, light.iter().map(pixel).collect())
}

/// An enlarged part, and of which pictures.
type WantedLens = (Wanted, Lens);

/// The enlarged part by the maps A and B and of the surroundings themselves.
type ShownLens = [TextureHandle; 3];

/// Looks at a part of the view anew, so that texels are seen and not pixels.
fn enlarged(
    (wanted, lens): &WantedLens,
    parts: &Parts,
    ctx: &Context,
    progress: &Progress,
) -> Option<ShownLens> {
    let frame = wanted.frame().part(lens.place.into(), lens.share);
    let rays = rays(
        &wanted.target,
        &frame,
        lens.size,
        MAGNIFIED_PER_SIDE,
        progress,
    )?;
    let picture = |name: &str, map: &EnvironmentMap, rotation: Rotation| {
        let light = rays.light(map, rotation, progress).ok()?;
        let image = image(&light, lens.size, wanted);
        Some(ctx.load_texture(name, image, TextureOptions::NEAREST))
    };
    let [(_, a), (_, b)] = &parts.maps;
    Some([
        picture("enlarged a", a, Rotation::NONE)?,
        picture("enlarged b", b, Rotation::NONE)?,
        picture("enlarged surroundings", &parts.source, wanted.rotation)?,
    ])
}

/// The last pictures, and the jobs that make the next ones.
#[derive(Default)]
pub struct BudgetLab {
    pictures: Follower<Wanted, Shown>,
    lens: Follower<WantedLens, ShownLens>,
}

impl BudgetLab {
    /// Makes what is wanted and not there; `None`: nobody looks. During a drag pictures that are under way are finished, or it
    /// would show none.
    ///
    /// # Errors
    /// When the system gives no thread.
    pub fn follow(
        &mut self,
        wanted: Option<Wanted>,
        lens: Option<Lens>,
        jobs: &mut Jobs<'_>,
    ) -> Result<(), String> {
        let making = self.pictures.making();
        let wanted = wanted.map(|wanted| match making {
            Some(making) if making.shows_as(&wanted) => making.clone(),
            _ => wanted,
        });
        let lens = self.wanted_lens(wanted.as_ref(), lens);
        let making = self.lens.making();
        let lens = lens.map(|lens| match making {
            Some(making) if making.0 == lens.0 => making.clone(),
            _ => lens,
        });
        let (parts, ctx) = (self.old(), jobs.ctx.clone());
        self.lens
            .follow(lens, "enlarging two maps", jobs, move |lens, progress| {
                enlarged(lens, &parts?.1, &ctx, progress)
            })?;
        let (old, ctx) = (self.old(), jobs.ctx.clone());
        let make = move |wanted: &Wanted, progress: &Progress| {
            Shown::of(wanted, old.as_ref(), &ctx, progress)
        };
        self.pictures
            .follow(wanted, "comparing two maps", jobs, make)
    }

    /// Makes what is wanted at once: for pictures.
    pub fn complete(&mut self, wanted: Option<Wanted>, lens: Option<Lens>, ctx: &Context) {
        let old = self.old();
        self.pictures.complete(wanted.clone(), |wanted, progress| {
            Shown::of(wanted, old.as_ref(), ctx, progress)
        });
        let lens = self.wanted_lens(wanted.as_ref(), lens);
        let parts = self.old();
        self.lens.complete(lens, |lens, progress| {
            enlarged(lens, &parts?.1, ctx, progress)
        });
    }

    /// What is enlarged, once its pictures are there.
    fn wanted_lens(&self, wanted: Option<&Wanted>, lens: Option<Lens>) -> Option<WantedLens> {
        let (shown, _) = self.pictures.shown()?;
        let shown = wanted.filter(|wanted| *wanted == shown)?;
        lens.map(|lens| (shown.clone(), lens))
    }

    /// The enlarged part of the pictures that are shown, if it is the one that is wanted.
    pub fn enlarged(&self, lens: Lens) -> Option<&[TextureHandle; 3]> {
        let ((of, shown), pictures) = self.lens.shown()?;
        let is_same = *shown == lens && self.pictures.shown().is_some_and(|(now, _)| now == of);
        is_same.then_some(pictures)
    }

    fn old(&self) -> Option<(Wanted, Parts)> {
        let (wanted, shown) = self.pictures.shown()?;
        Some((wanted.clone(), shown.parts.clone()))
    }

    /// Lets go of pictures of other surroundings.
    pub fn forget_others(&mut self, loaded: &Arc<Loaded>) {
        let loaded = Shared::from(Arc::clone(loaded));
        self.pictures.forget(|wanted| wanted.loaded != loaded);
        self.lens.forget(|(wanted, _)| wanted.loaded != loaded);
    }

    /// The last pictures, and what they were made for.
    pub fn shown(&self) -> Option<(&Wanted, &Shown)> {
        self.pictures.shown()
    }
}

impl Lab for BudgetLab {
    fn poll(&mut self, _: &Context) {
        self.pictures.poll();
        self.lens.poll();
    }

    fn jobs(&self) -> Vec<JobLine> {
        self.pictures.job().into_iter().collect()
    }

    /// The enlarged part is no line of its own: it comes sooner than a line is read, and again wherever the pointer goes.
    fn is_busy(&self) -> bool {
        self.pictures.job().is_some() || self.lens.job().is_some()
    }

    fn cancel(&mut self, id: u64) {
        self.pictures.cancel(id);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::app::objects::target_of;
    use crate::imaging::Image;
    use crate::mapping::MappingId::{Ccm, Cube, Eac};
    use crate::scene::Object;

    #[test]
    fn what_is_the_same_is_not_made_again() {
        let image = Image::new(2, 1, vec![[0.25; 3], [0.5; 3]]).unwrap();
        let loaded = Arc::new(Loaded::from_image(image, &Progress::new()));
        let mut state = AppState::default();
        state.budget.maps = [Some(Cube), Some(Ccm)];
        let wanted = |change: &dyn Fn(&mut AppState)| {
            let mut state = state.clone();
            change(&mut state);
            Wanted::new(&state, &loaded, target_of(Object::Sphere).into(), [24, 16])
        };
        let first = wanted(&|_| {});
        let parts = Parts::of(&first, None, &Progress::new()).unwrap();
        let old = (first.clone(), parts.clone());
        // Which of source, rays, surroundings' light, maps A and B and their lights were kept.
        let kept = |change: &dyn Fn(&mut AppState)| {
            let next = Parts::of(&wanted(change), Some(&old), &Progress::new()).unwrap();
            [
                Arc::ptr_eq(&next.source, &parts.source),
                Arc::ptr_eq(&next.rays, &parts.rays),
                Arc::ptr_eq(&next.surroundings, &parts.surroundings),
                Arc::ptr_eq(&next.maps[0].1, &parts.maps[0].1),
                Arc::ptr_eq(&next.maps[1].1, &parts.maps[1].1),
                Arc::ptr_eq(&next.light[0], &parts.light[0]),
                Arc::ptr_eq(&next.light[1], &parts.light[1]),
            ]
        };
        assert_eq!(kept(&|state| state.exposure_ev = 1.0), [true; 7]);
        assert_eq!(
            kept(&|state| state.camera.yaw_rad = 1.0),
            [true, false, false, true, true, false, false]
        );
        assert_eq!(
            kept(&|state| state.budget.maps[1] = Some(Eac)),
            [true, true, true, true, false, true, false]
        );
        assert_eq!(
            kept(&|state| state.budget.texels *= 4),
            [true, true, true, false, false, false, false]
        );
        assert_eq!(
            kept(&|state| state.rotation.yaw_deg = 90.0),
            [true, true, false, false, false, false, false]
        );
        // Exchanged, each is found on the other side.
        let exchanged = wanted(&|state| state.budget.maps = [Some(Ccm), Some(Cube)]);
        let exchanged = Parts::of(&exchanged, Some(&old), &Progress::new()).unwrap();
        assert!(Arc::ptr_eq(&exchanged.light[0], &parts.light[1]));
        // Only what is dragged lets a job end.
        assert!(first.shows_as(&wanted(&|state| state.camera.yaw_rad = 1.0)));
        assert!(!first.shows_as(&wanted(&|state| state.budget.maps[1] = Some(Eac))));
    }

    #[test]
    fn pixels_have_as_many_rays_as_there_may_be() {
        for (size, per_side) in [([100, 100], 4), ([318, 240], 2), ([1024, 512], 1)] {
            assert_eq!(rays_per_side(size), per_side, "{size:?}");
        }
        assert_eq!(rays_per_side([u32::MAX; 2]), 1);
    }
}
