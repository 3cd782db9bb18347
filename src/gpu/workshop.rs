//! Pipelines by what they draw, compiled aside while the window goes on.

use std::collections::BTreeMap;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use super::kit::Kit;

/// How a pipeline is made.
type Make<K> = fn(&Kit, K) -> wgpu::RenderPipeline;

/// The pipelines of one kind.
#[derive(Debug)]
pub(super) struct Workshop<K> {
    make: Make<K>,
    ready: BTreeMap<K, wgpu::RenderPipeline>,
    coming: BTreeMap<K, Receiver<wgpu::RenderPipeline>>,
}

impl<K: Ord + Copy + Send + 'static> Workshop<K> {
    /// Nothing made yet.
    pub fn new(make: Make<K>) -> Self {
        Self {
            make,
            ready: BTreeMap::new(),
            coming: BTreeMap::new(),
        }
    }

    /// True when the pipeline is there. If not, it is compiled: here and now, or `aside`, on a thread of its own; then ask
    /// again later.
    pub fn has(&mut self, kit: &Kit, key: K, aside: bool) -> bool {
        if self.ready.contains_key(&key) {
            return true;
        }
        if aside && let Some(coming) = self.coming.get(&key) {
            match coming.try_recv() {
                Ok(pipeline) => {
                    self.coming.remove(&key);
                    self.ready.insert(key, pipeline);
                    return true;
                }
                Err(TryRecvError::Empty) => return false,
                // The thread is gone without a pipeline: make it here.
                Err(TryRecvError::Disconnected) => {}
            }
        } else if aside && self.start(kit, key) {
            return false;
        }
        self.coming.remove(&key);
        self.ready.insert(key, (self.make)(kit, key));
        true
    }

    /// Compiles on another thread; false when the system gives none.
    fn start(&mut self, kit: &Kit, key: K) -> bool {
        let (sender, receiver) = channel();
        let (kit, make) = (kit.clone(), self.make);
        let thread = std::thread::Builder::new().name("shader".to_owned());
        let started = thread.spawn(move || {
            // Nobody listens any more to what is not shown any more.
            drop(sender.send(make(&kit, key)));
        });
        if started.is_ok() {
            self.coming.insert(key, receiver);
        }
        started.is_ok()
    }

    /// A pipeline that [`has`](Self::has) found.
    pub fn get(&self, key: K) -> Option<&wgpu::RenderPipeline> {
        self.ready.get(&key)
    }

    /// Drops what is not kept.
    pub fn retain(&mut self, keep: impl Fn(&K) -> bool) {
        self.ready.retain(|key, _| keep(key));
        self.coming.retain(|key, _| keep(key));
    }

    /// Number of pipelines that are there.
    pub fn len(&self) -> usize {
        self.ready.len()
    }
}
