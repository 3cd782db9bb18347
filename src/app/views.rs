//! The renderer's textures as pictures that egui can show.

use std::collections::HashMap;
use std::sync::Arc;

use egui::TextureId;
use egui::mutex::RwLock;

use crate::gpu::Gpu;
use crate::mapping::MappingId;

/// What a texture shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum ViewKey {
    /// The viewport.
    Viewport,
    /// The unfolded picture of a mapping.
    Panel(MappingId),
}

/// egui's names for the textures. A name stays the same while its texture is made anew at another size.
pub struct Views {
    painter: Arc<RwLock<egui_wgpu::Renderer>>,
    blank: wgpu::TextureView,
    known: HashMap<ViewKey, Known>,
}

struct Known {
    id: TextureId,
    /// Identity of the texture that stands behind the name, `None` for the blank one.
    shown: Option<u64>,
}

impl Views {
    /// No views yet.
    pub fn new(gpu: &Gpu, painter: Arc<RwLock<egui_wgpu::Renderer>>) -> Self {
        let blank = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("blank view"),
            size: wgpu::Extent3d::default(),
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8Unorm,
            usage: wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        Self {
            painter,
            blank: blank.create_view(&Default::default()),
            known: HashMap::new(),
        }
    }

    /// egui's name for a view; black until something is drawn.
    pub fn id(&mut self, gpu: &Gpu, key: ViewKey) -> TextureId {
        let (painter, blank) = (&self.painter, &self.blank);
        self.known
            .entry(key)
            .or_insert_with(|| {
                let mut painter = painter.write();
                let filter = wgpu::FilterMode::Nearest;
                let id = painter.register_native_texture(&gpu.device, blank, filter);
                Known { id, shown: None }
            })
            .id
    }

    /// Puts the renderer's texture behind a name, if another one stood there. `identity` tells textures apart.
    pub fn show(&mut self, gpu: &Gpu, key: ViewKey, texture: Option<(&wgpu::TextureView, u64)>) {
        let Some(known) = self.known.get_mut(&key) else {
            return;
        };
        let identity = texture.map(|(_, identity)| identity);
        if known.shown == identity {
            return;
        }
        known.shown = identity;
        let view = texture.map_or(&self.blank, |(view, _)| view);
        self.painter.write().update_egui_texture_from_wgpu_texture(
            &gpu.device,
            view,
            wgpu::FilterMode::Nearest,
            known.id,
        );
    }

    /// Forgets the views that nobody shows, so that their textures can go.
    pub fn retain(&mut self, shown: impl Fn(ViewKey) -> bool) {
        let painter = &self.painter;
        self.known.retain(|key, known| {
            let keep = shown(*key);
            if !keep {
                painter.write().free_texture(&known.id);
            }
            keep
        });
    }
}
