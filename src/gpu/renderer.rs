//! The renderer of one scene: owns every GPU object, draws what changed and is seen, and nothing else.

use std::collections::BTreeMap;

use super::environment::{EnvironmentSource, EnvironmentTexture};
use super::frame::{Frame, PanelFrame, Side, ViewportFrame};
use super::kit::{Kit, texture_bytes};
use super::map::{GUTTER, MAP_LEVELS, Map, map_size};
use super::panel::Panel;
use super::plan::{Drawn, Node, Plan};
use super::program::Work;
use super::readback::{
    MapPixels, Part, RgbaPixels, TexelRead, light_from_bytes, read_part, read_view,
};
use super::report::Report;
use super::viewport::{Viewport, samples};
use super::workshop::Workshop;
use super::{Gpu, GpuError};
use crate::mapping::MappingId;

/// Why nothing was drawn.
#[derive(Debug, thiserror::Error)]
pub enum RenderError {
    /// The environment's size and its number of pixels do not belong together.
    #[error("an environment of {width} x {height} cannot have {pixels} pixels")]
    BadEnvironment {
        /// Texels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// Pixels given.
        pixels: usize,
    },
    /// Something would be larger than the device's textures can be.
    #[error(
        "the {node} would be {width} x {height} texels, and this device takes {most} a side; choose less"
    )]
    TooLarge {
        /// What.
        node: Node,
        /// Texels in a row.
        width: u32,
        /// Rows.
        height: u32,
        /// The device's limit for both.
        most: u32,
    },
    /// There is nothing to be read: it is not seen, or does not reach so far.
    #[error("the {0} has no such pixels now; show it first")]
    NotShown(Node),
    /// The device is gone, and with it everything on it; open a new one and make a new renderer.
    #[error("the graphics device was lost ({0}); open a new one")]
    DeviceLost(String),
    /// The device refused or ran out of memory; what it should have drawn will be tried again by the next call.
    #[error(transparent)]
    Gpu(GpuError),
}

impl From<GpuError> for RenderError {
    fn from(error: GpuError) -> Self {
        match error {
            GpuError::Lost(reason) => Self::DeviceLost(reason),
            other => Self::Gpu(other),
        }
    }
}

/// Draws one scene. See the [module](self).
#[derive(Debug)]
pub struct Renderer {
    kit: Kit,
    /// With a number that counts up with every environment.
    environment: Option<(u64, EnvironmentTexture)>,
    maps: BTreeMap<MappingId, Map>,
    bakers: Workshop<MappingId>,
    viewport: Option<Viewport>,
    panels: BTreeMap<MappingId, Panel>,
    panel_passes: Workshop<MappingId>,
    drawn: Drawn,
    report: Report,
    /// Numbers for environments and views; never used twice.
    last_number: u64,
}

impl Renderer {
    /// A renderer that shows nothing yet and has made no texture and no pipeline.
    #[must_use]
    pub fn new(gpu: Gpu) -> Self {
        Self {
            kit: Kit::new(gpu),
            environment: None,
            maps: BTreeMap::new(),
            bakers: Workshop::new(Map::pipeline),
            viewport: None,
            panels: BTreeMap::new(),
            panel_passes: Workshop::new(Panel::pipeline),
            drawn: Drawn::default(),
            report: Report::default(),
            last_number: 0,
        }
    }

    /// The device that is drawn on.
    #[must_use]
    pub fn gpu(&self) -> &Gpu {
        &self.kit.gpu
    }

    /// Replaces the environment; maps are baked again as they are seen. A picture larger than the device's textures is
    /// halved until it fits. After an error the old environment stays.
    pub fn set_environment(&mut self, image: EnvironmentSource<'_>) -> Result<(), RenderError> {
        let texture = EnvironmentTexture::new(&self.kit.gpu, image)?;
        self.install_environment(texture);
        Ok(())
    }

    /// As [`set_environment`](Self::set_environment), with what another thread has made ready on the same device.
    pub fn install_environment(&mut self, texture: EnvironmentTexture) {
        self.environment = Some((self.next_number(), texture));
    }

    /// Draws what the frame shows and what is not right yet; sends nothing to the device when all is. Without an
    /// environment nothing is drawn.
    ///
    /// At most one map is baked in a call unless the frame asks for all; [`Report::is_pending`] then says that more is to
    /// come. What is not seen any more is dropped: its textures and its pipelines.
    pub fn draw(&mut self, frame: &Frame) -> Result<&Report, RenderError> {
        let gpu = self.kit.gpu.clone();
        if gpu.is_lost() {
            return Err(RenderError::DeviceLost("before drawing".into()));
        }
        let mut frame = frame.normalized();
        // A GL device belongs to one thread at a time: compiling aside would make this one wait all the same.
        frame.compile_aside &= gpu.adapter_info.backend != wgpu::Backend::Gl;
        self.check_sizes(&frame)?;
        let mut plan = Plan::new(
            &self.drawn,
            &frame,
            samples(&self.kit, &frame),
            self.environment.as_ref().map(|(number, _)| *number),
        );
        self.drop_unseen(&frame);
        if !plan.run.is_empty() {
            match gpu.checked(|_| self.run(&plan, &frame)) {
                Ok(held) => plan.hold_back(&held, &self.drawn),
                Err(error) => {
                    self.forget();
                    return Err(error.into());
                }
            }
        }
        self.drawn = plan.drawn;
        self.report.object = frame.viewport.as_ref().map_or_else(Vec::new, |viewport| {
            let sides = viewport.sides().into_iter();
            let work = |side: Side<'_>| Work::new(side.program, &side.object.material);
            sides.map(work).collect()
        });
        self.report.enter(plan.run, plan.skipped, plan.pending);
        self.count();
        Ok(&self.report)
    }

    /// What the last call of [`draw`](Self::draw) did.
    #[must_use]
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// The viewport's picture: sRGB values in a format without conversion. `None` until it has been drawn.
    #[must_use]
    pub fn viewport(&self) -> Option<&wgpu::TextureView> {
        self.viewport.as_ref().map(|v| &v.view)
    }

    /// The texture of [`viewport`](Self::viewport).
    #[must_use]
    pub fn viewport_texture(&self) -> Option<&wgpu::Texture> {
        self.viewport.as_ref().map(Viewport::texture)
    }

    /// A number that changes whenever [`viewport`](Self::viewport) is another view than before, never used for another
    /// view or panel.
    #[must_use]
    pub fn viewport_id(&self) -> Option<u64> {
        self.viewport.as_ref().map(|v| v.id)
    }

    /// A panel's picture; see [`viewport`](Self::viewport).
    #[must_use]
    pub fn panel(&self, id: MappingId) -> Option<&wgpu::TextureView> {
        self.panels.get(&id).map(|p| &p.view)
    }

    /// The texture of [`panel`](Self::panel).
    #[must_use]
    pub fn panel_texture(&self, id: MappingId) -> Option<&wgpu::Texture> {
        self.panels.get(&id).map(|p| &p.texture)
    }

    /// See [`viewport_id`](Self::viewport_id).
    #[must_use]
    pub fn panel_id(&self, id: MappingId) -> Option<u64> {
        self.panels.get(&id).map(|p| p.id)
    }

    /// Width and height of a mapping's charts in texels, while there is a map.
    #[must_use]
    pub fn map_size(&self, id: MappingId) -> Option<[u32; 2]> {
        self.maps.get(&id).map(|map| map.size)
    }

    /// Waits for the pixels of [`viewport_texture`](Self::viewport_texture) or [`panel_texture`](Self::panel_texture).
    pub fn read_texture(&self, texture: &wgpu::Texture) -> Result<RgbaPixels, RenderError> {
        read_view(&self.kit.gpu, texture)
    }

    /// Waits for one level of one chart, gutter included.
    pub fn read_map(
        &self,
        id: MappingId,
        chart: u32,
        level: u32,
    ) -> Result<MapPixels, RenderError> {
        let map = self
            .maps
            .get(&id)
            .filter(|_| chart < id.info().chart_count());
        let map = map.filter(|_| level < MAP_LEVELS);
        let map = map.ok_or(RenderError::NotShown(Node::Map(id)))?;
        let gutter = GUTTER >> level;
        let size = map.size.map(|n| (n >> level) + 2 * gutter);
        let part = Part {
            layer: chart,
            level,
            origin: [0, 0],
            size,
        };
        let bytes = read_part(&self.kit.gpu, &map.texture, part)?;
        Ok(MapPixels {
            width: size[0],
            height: size[1],
            gutter,
            rgb: light_from_bytes(&bytes),
        })
    }

    /// Waits for the linear light of texel [i, j] of a chart.
    pub fn read_texel(
        &self,
        id: MappingId,
        chart: u32,
        texel: [u32; 2],
    ) -> Result<[f32; 3], RenderError> {
        let (map, origin) = self.texel_place(id, chart, texel)?;
        let part = Part {
            layer: chart,
            level: 0,
            origin,
            size: [1, 1],
        };
        let bytes = read_part(&self.kit.gpu, &map.texture, part)?;
        let light = light_from_bytes(&bytes).first().copied();
        light.ok_or(RenderError::NotShown(Node::Map(id)))
    }

    /// Sends for the linear light of texel [i, j] of a chart; [`TexelRead::poll`] tells when it has come.
    pub fn begin_read_texel(
        &self,
        id: MappingId,
        chart: u32,
        texel: [u32; 2],
    ) -> Result<TexelRead, RenderError> {
        let (map, origin) = self.texel_place(id, chart, texel)?;
        TexelRead::begin(&self.kit.gpu, &map.texture, chart, origin)
    }

    /// The map and the place in its texture of a texel.
    fn texel_place(
        &self,
        id: MappingId,
        chart: u32,
        [i, j]: [u32; 2],
    ) -> Result<(&Map, [u32; 2]), RenderError> {
        let is_on =
            |map: &&Map| chart < id.info().chart_count() && i < map.size[0] && j < map.size[1];
        let map = self.maps.get(&id).filter(is_on);
        let map = map.ok_or(RenderError::NotShown(Node::Map(id)))?;
        Ok((map, [i + GUTTER, j + GUTTER]))
    }

    fn next_number(&mut self) -> u64 {
        self.last_number += 1;
        self.last_number
    }

    /// Refuses what the device cannot hold before anything is made.
    fn check_sizes(&self, frame: &Frame) -> Result<(), RenderError> {
        let most = self.kit.gpu.device.limits().max_texture_dimension_2d;
        let maps = frame.mappings().into_iter().map(|id| {
            let size = map_size(id, frame.texel_budget).map(|n| n.saturating_add(2 * GUTTER));
            (Node::Map(id), size)
        });
        let viewport = frame.viewport.iter().map(|v| (Node::Viewport, v.size_px));
        let panels = frame
            .panels
            .iter()
            .map(|p| (Node::Panel(p.mapping), p.size_px));
        for (node, [width, height]) in maps.chain(viewport).chain(panels) {
            if width.max(height) > most {
                return Err(RenderError::TooLarge {
                    node,
                    width,
                    height,
                    most,
                });
            }
        }
        Ok(())
    }

    /// Drops everything that the frame does not need.
    fn drop_unseen(&mut self, frame: &Frame) {
        let shown = frame.mappings();
        self.maps.retain(|id, _| shown.contains(id));
        self.bakers.retain(|id| shown.contains(id));
        let is_seen = |id: &MappingId| frame.panels.iter().any(|p| p.mapping == *id);
        self.panels.retain(|id, _| is_seen(id));
        self.panel_passes.retain(is_seen);
        match (&mut self.viewport, &frame.viewport) {
            (Some(viewport), Some(seen)) => viewport.keep_only(seen),
            (viewport, _) => *viewport = None,
        }
    }

    /// After an error nothing is trusted: all is drawn anew by the next call.
    fn forget(&mut self) {
        self.drawn = Drawn::default();
        self.maps.clear();
        self.bakers.retain(|_| false);
        self.panels.clear();
        self.panel_passes.retain(|_| false);
        self.viewport = None;
    }

    /// Draws the plan's nodes and submits. Gives back those that must wait for a shader, and for a map that does.
    fn run(&mut self, plan: &Plan, frame: &Frame) -> Vec<Node> {
        let mut held = Vec::new();
        let mut encoder =
            self.kit
                .gpu
                .device
                .create_command_encoder(&wgpu::CommandEncoderDescriptor {
                    label: Some("frame"),
                });
        for node in &plan.run {
            let has_map = |id: MappingId| !held.contains(&Node::Map(id));
            let is_drawn = match *node {
                Node::Map(id) => self.run_map(&mut encoder, plan, id, frame.compile_aside),
                Node::Viewport => frame.viewport.as_ref().is_none_or(|viewport| {
                    viewport.mappings().all(has_map)
                        && self.run_viewport(&mut encoder, frame, viewport)
                }),
                Node::Panel(id) => {
                    let panel = frame.panels.iter().find(|p| p.mapping == id);
                    panel.is_none_or(|panel| {
                        has_map(id) && self.run_panel(&mut encoder, frame, panel)
                    })
                }
            };
            if !is_drawn {
                held.push(*node);
            }
        }
        if held.len() < plan.run.len() {
            self.kit.gpu.queue.submit([encoder.finish()]);
        }
        held
    }

    /// False while its shader is compiled aside; so with the next two.
    fn run_map(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        plan: &Plan,
        id: MappingId,
        aside: bool,
    ) -> bool {
        let (Some((_, environment)), Some(key)) = (&self.environment, plan.drawn.maps.get(&id))
        else {
            return true;
        };
        let kit = &self.kit;
        let is_ready = self.bakers.has(kit, id, aside);
        let Some(pipeline) = self.bakers.get(id).filter(|_| is_ready) else {
            return false;
        };
        let map = self
            .maps
            .entry(id)
            .or_insert_with(|| Map::new(kit, id, key.size, key.as_cube));
        if map.size != key.size || map.is_cube() != key.as_cube {
            *map = Map::new(kit, id, key.size, key.as_cube);
        }
        map.bake(kit, encoder, pipeline, id, environment, key.rotation);
        true
    }

    fn run_viewport(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        frame: &Frame,
        seen: &ViewportFrame,
    ) -> bool {
        let number = self.next_number();
        let kit = &self.kit;
        let samples = samples(kit, frame);
        let viewport = self
            .viewport
            .get_or_insert_with(|| Viewport::new(kit, seen, samples, number));
        if !viewport.is_ready(kit, seen, &self.maps, samples, frame.compile_aside) {
            return false;
        }
        viewport.prepare(kit, seen, samples, number);
        viewport.draw(kit, encoder, seen, frame.look(), &self.maps);
        true
    }

    fn run_panel(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        frame: &Frame,
        seen: &PanelFrame,
    ) -> bool {
        let number = self.next_number();
        let Some(map) = self.maps.get(&seen.mapping) else {
            return true;
        };
        let kit = &self.kit;
        let is_ready = self
            .panel_passes
            .has(kit, seen.mapping, frame.compile_aside);
        let Some(pipeline) = self.panel_passes.get(seen.mapping).filter(|_| is_ready) else {
            return false;
        };
        let make = || Panel::new(kit, seen, number);
        let panel = self.panels.entry(seen.mapping).or_insert_with(make);
        panel.prepare(kit, seen, number);
        panel.draw(kit, encoder, pipeline, seen, frame.look(), &map.view);
        true
    }

    /// Counts what is alive.
    fn count(&mut self) {
        let textures: Vec<&wgpu::Texture> = self
            .environment
            .iter()
            .map(|(_, environment)| &environment.texture)
            .chain(self.maps.values().flat_map(Map::textures))
            .chain(self.viewport.iter().flat_map(Viewport::textures))
            .chain(self.panels.values().map(|p| &p.texture))
            .collect();
        self.report.textures = textures.len();
        self.report.texture_bytes = textures.into_iter().map(texture_bytes).sum();
        self.report.pipelines = self.bakers.len()
            + self.panel_passes.len()
            + self.viewport.as_ref().map_or(0, Viewport::pipeline_count);
    }
}
