//! A panel: one mapping's charts, unfolded into one picture.

use super::frame::{Look, PanelFrame};
use super::kit::{Kit, PANEL, VIEW_FORMAT, begin_pass, show_source};
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
    pipeline: wgpu::RenderPipeline,
}

impl Panel {
    pub fn new(kit: &Kit, mapping: MappingId, size_px: [u32; 2], id: u64) -> Self {
        let texture = kit.view_texture("panel", size_px);
        Self {
            view: texture.create_view(&wgpu::TextureViewDescriptor::default()),
            texture,
            id,
            block: kit.block_buffer("panel", size_of::<uniforms::Panel>()),
            pipeline: kit.screen_pipeline(
                &kit.lookup,
                &show_source(mapping, PANEL),
                "panel_fragment",
                VIEW_FORMAT,
            ),
        }
    }

    /// Gives the panel this size; `id` becomes the new texture's, if there is one.
    pub fn resize(&mut self, kit: &Kit, size_px: [u32; 2], id: u64) {
        if size_px != [self.texture.width(), self.texture.height()] {
            self.texture = kit.view_texture("panel", size_px);
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
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &kit.lookup_group(&self.block, map), &[]);
        pass.draw(0..3, 0..1);
    }
}
