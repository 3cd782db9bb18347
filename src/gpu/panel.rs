//! A panel: one mapping's charts, unfolded into one picture.

use super::frame::{Look, PanelFrame};
use super::kit::{Kit, VIEW_FORMAT, begin_pass, panel_source};
use super::uniforms;
use crate::mapping::MappingId;

/// Everything of one panel on the device.
#[derive(Debug)]
pub(super) struct Panel {
    pub texture: wgpu::Texture,
    pub view: wgpu::TextureView,
    /// Changes with every new texture.
    pub id: u64,
    block: wgpu::Buffer,
}

impl Panel {
    pub fn new(kit: &Kit, frame: &PanelFrame, id: u64) -> Self {
        let texture = kit.view_texture("panel", frame.size_px);
        Self {
            view: texture.create_view(&wgpu::TextureViewDescriptor::default()),
            texture,
            id,
            block: kit.block_buffer("panel", size_of::<uniforms::Panel>()),
        }
    }

    /// Compiles the pass that draws panels of `id`.
    pub fn pipeline(kit: &Kit, id: MappingId) -> wgpu::RenderPipeline {
        let source = panel_source(id);
        kit.screen_pipeline(&kit.lookup, &source, "panel_fragment", VIEW_FORMAT)
    }

    /// Makes what the frame needs and the panel lacks; `id` becomes the new texture's, if there is one.
    pub fn prepare(&mut self, kit: &Kit, frame: &PanelFrame, id: u64) {
        if frame.size_px != [self.texture.width(), self.texture.height()] {
            self.texture = kit.view_texture("panel", frame.size_px);
            self.view = self
                .texture
                .create_view(&wgpu::TextureViewDescriptor::default());
            self.id = id;
        }
    }

    pub fn draw(
        &self,
        kit: &Kit,
        encoder: &mut wgpu::CommandEncoder,
        pipeline: &wgpu::RenderPipeline,
        frame: &PanelFrame,
        look: Look,
        map: &wgpu::TextureView,
    ) {
        let [width, height] = frame.size_px.map(|n| n as f32);
        let block = uniforms::Panel {
            window: frame.window,
            background: uniforms::vec4(
                frame.background.map(|c| f32::from(c) / 255.0),
                look.exposure,
            ),
            screen: [width, height, look.tone.index() as f32, 0.0],
            overlays: frame.overlays.switches(),
        };
        kit.gpu
            .queue
            .write_buffer(&self.block, 0, bytemuck::bytes_of(&block));
        let mut pass = begin_pass(encoder, "panel", &self.view);
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &kit.lookup_group(&self.block, map), &[]);
        pass.draw(0..3, 0..1);
    }
}
