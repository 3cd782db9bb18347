//! The device: found without a window or taken over from one, never a panic, and lost with a note.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Largest texture side that is asked for: a 16K panorama. Adapters that offer less give less.
pub const WANTED_TEXTURE_SIDE: u32 = 16_384;

/// Largest buffer that is asked for, in bytes: one read back of an 8K x 8K picture of four f32.
pub const WANTED_BUFFER_BYTES: u64 = 1 << 30;

/// How long a read back waits for the device. Software adapters on a busy machine need seconds, never a minute.
pub const PATIENCE: Duration = Duration::from_secs(60);

/// Features that are switched on where they exist; nothing depends on them.
const OPTIONAL_FEATURES: wgpu::Features =
    wgpu::Features::TIMESTAMP_QUERY.union(wgpu::Features::FLOAT32_FILTERABLE);

/// The interfaces that are tried first; GL comes after them.
const FIRST_CHOICE: wgpu::Backends = wgpu::Backends::VULKAN
    .union(wgpu::Backends::METAL)
    .union(wgpu::Backends::DX12);

/// What went wrong with the device.
#[derive(Clone, Debug, thiserror::Error)]
pub enum GpuError {
    /// No adapter was found.
    #[error(
        "no graphics adapter was found for {tried:?}; install a Vulkan driver (on Linux without a GPU Mesa's lavapipe, \
         e.g. the package mesa-vulkan-drivers), or set WGPU_BACKEND to vulkan, metal, dx12 or gl"
    )]
    NoAdapter {
        /// The interfaces that were asked.
        tried: wgpu::Backends,
    },
    /// Adapters were found, but none gave a device; the reason is the last one's.
    #[error(
        "the adapter {adapter} gave no device: {reason}; update its driver or set WGPU_BACKEND to another interface"
    )]
    NoDevice {
        /// Name and interface of the adapter.
        adapter: String,
        /// What it answered.
        reason: String,
    },
    /// The device refused an operation or ran out of memory.
    #[error("the graphics device refused: {0}")]
    Refused(String),
    /// The device did not answer within [`PATIENCE`].
    #[error("the graphics device did not answer within {} s", PATIENCE.as_secs())]
    Timeout,
    /// The device is gone: driver reset, unplugged or destroyed.
    #[error("the graphics device was lost ({0}); open a new one")]
    Lost(String),
}

/// A device with its queue. Clones share both, and share what is known of their faults.
#[derive(Clone, Debug)]
pub struct Gpu {
    /// Makes resources.
    pub device: wgpu::Device,
    /// Takes commands.
    pub queue: wgpu::Queue,
    /// What the adapter is called and which interface it is reached through.
    pub adapter_info: Arc<wgpu::AdapterInfo>,
    faults: Arc<Faults>,
}

/// What the device's callbacks have reported.
#[derive(Debug, Default)]
struct Faults {
    lost: AtomicBool,
    loss: Mutex<String>,
    error: Mutex<Option<String>>,
}

impl Gpu {
    /// The best device that works without a window. Interfaces come from WGPU_BACKEND, or Vulkan, Metal and DX12 first and
    /// GL when those have none; a GPU is preferred to a software adapter.
    pub fn headless() -> Result<Self, GpuError> {
        match wgpu::Backends::from_env() {
            Some(backends) => Self::open(&[backends]),
            None => Self::open(&[FIRST_CHOICE, wgpu::Backends::GL]),
        }
    }

    /// The best device of the first of these groups of interfaces that has one.
    pub fn open(choices: &[wgpu::Backends]) -> Result<Self, GpuError> {
        let mut failure = GpuError::NoAdapter {
            tried: choices.iter().copied().collect(),
        };
        for adapter in choices.iter().flat_map(|backends| adapters(*backends)) {
            match Self::from_adapter(&adapter) {
                Ok(gpu) => return Ok(gpu),
                Err(error) => failure = error,
            }
        }
        Err(failure)
    }

    /// A device on every adapter of this machine, software ones included; WGPU_BACKEND narrows the choice.
    pub fn on_every_adapter() -> Result<Vec<Self>, GpuError> {
        let tried = wgpu::Backends::from_env().unwrap_or(FIRST_CHOICE | wgpu::Backends::GL);
        let adapters = adapters(tried);
        if adapters.is_empty() {
            return Err(GpuError::NoAdapter { tried });
        }
        adapters.iter().map(Self::from_adapter).collect()
    }

    /// A device of this adapter.
    pub fn from_adapter(adapter: &wgpu::Adapter) -> Result<Self, GpuError> {
        let info = adapter.get_info();
        let request = adapter.request_device(&device_descriptor(adapter));
        let (device, queue) = pollster::block_on(request).map_err(|error| GpuError::NoDevice {
            adapter: format!("{} ({})", info.name, info.backend),
            reason: error.to_string(),
        })?;
        Ok(Self::from_parts(device, queue, info))
    }

    /// Takes over a device that someone else made (the window's). Its error and loss callbacks are replaced: wgpu's own
    /// would end the program.
    pub fn from_parts(
        device: wgpu::Device,
        queue: wgpu::Queue,
        adapter_info: wgpu::AdapterInfo,
    ) -> Self {
        let faults = Arc::new(Faults::default());
        let on_error = Arc::clone(&faults);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            *locked(&on_error.error) = Some(error.to_string());
        }));
        let on_loss = Arc::clone(&faults);
        device.set_device_lost_callback(move |reason, message| {
            *locked(&on_loss.loss) = format!("{reason:?}: {message}");
            on_loss.lost.store(true, Ordering::Release);
        });
        Self {
            device,
            queue,
            adapter_info: Arc::new(adapter_info),
            faults,
        }
    }

    /// Name and interface of the adapter, for people.
    pub fn name(&self) -> String {
        format!("{} ({})", self.adapter_info.name, self.adapter_info.backend)
    }

    /// True once the device is gone for good: nothing drawn on it will appear, and everything on it must be made again.
    pub fn is_lost(&self) -> bool {
        self.faults.lost.load(Ordering::Acquire)
    }

    /// The last error outside of [`checked`](Self::checked) since this was asked, if any.
    pub fn take_error(&self) -> Option<String> {
        locked(&self.faults.error).take()
    }

    /// Runs `work` and reports what the device refused of it: invalid use and lack of memory. The result of refused work
    /// exists but must not be used, so it is dropped.
    pub fn checked<T>(&self, work: impl FnOnce(&wgpu::Device) -> T) -> Result<T, GpuError> {
        self.alive()?;
        let memory = self.device.push_error_scope(wgpu::ErrorFilter::OutOfMemory);
        let internal = self.device.push_error_scope(wgpu::ErrorFilter::Internal);
        let validity = self.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let result = work(&self.device);
        // Scopes are a stack, so the last comes off first; off the web their futures are ready at once.
        let errors = [validity, internal, memory].map(|scope| pollster::block_on(scope.pop()));
        match errors.into_iter().flatten().next() {
            Some(error) => Err(GpuError::Refused(one_line(&error.to_string()))),
            None => self.alive().map(|()| result),
        }
    }

    /// The bytes of a buffer that was made for mapping; waits for the work that was submitted before, at most
    /// [`PATIENCE`]. Leaves the buffer unmapped.
    pub fn read_buffer(&self, buffer: &wgpu::Buffer, bytes: u64) -> Result<Vec<u8>, GpuError> {
        let (sender, receiver) = std::sync::mpsc::channel();
        self.checked(|_| {
            buffer.map_async(wgpu::MapMode::Read, ..bytes, move |mapped| {
                // Nobody listens any more after a timeout; that is not an error here.
                let _ = sender.send(mapped);
            });
        })?;
        self.wait()?;
        // Another thread that waits on this device may have taken the callback up and still be about to call it.
        receiver
            .recv_timeout(PATIENCE)
            .map_err(|_| GpuError::Timeout)?
            .map_err(|error| GpuError::Refused(error.to_string()))?;
        let view = buffer
            .get_mapped_range(..bytes)
            .map_err(|error| GpuError::Refused(error.to_string()))?;
        let data = view.to_vec();
        drop(view);
        buffer.unmap();
        Ok(data)
    }

    /// Waits for all work that was submitted, at most [`PATIENCE`].
    ///
    /// In slices, because GL waits at most 4 s at a time: its timeout is counted in nanoseconds of 32 bits.
    pub fn wait(&self) -> Result<(), GpuError> {
        const SLICE: Duration = Duration::from_secs(1);
        let end = Instant::now() + PATIENCE;
        loop {
            let polled = self.device.poll(wgpu::PollType::Wait {
                submission_index: None,
                timeout: Some(SLICE),
            });
            self.alive()?;
            match polled {
                Ok(_) => return Ok(()),
                Err(wgpu::PollError::Timeout) if Instant::now() < end => {}
                Err(wgpu::PollError::Timeout) => return Err(GpuError::Timeout),
                Err(other) => return Err(GpuError::Refused(one_line(&other.to_string()))),
            }
        }
    }

    /// An error once the device is lost.
    fn alive(&self) -> Result<(), GpuError> {
        if self.is_lost() {
            return Err(GpuError::Lost(locked(&self.faults.loss).clone()));
        }
        Ok(())
    }
}

/// A device's answer as one line: it explains itself over several.
fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Every adapter of these interfaces, GPUs before software adapters. Vulkan and GL each list the same card.
pub fn adapters(backends: wgpu::Backends) -> Vec<wgpu::Adapter> {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor {
        backends,
        flags: wgpu::InstanceFlags::from_build_config().with_env(),
        backend_options: wgpu::BackendOptions::from_env_or_default(),
        ..wgpu::InstanceDescriptor::new_without_display_handle()
    });
    let mut adapters = pollster::block_on(instance.enumerate_adapters(backends));
    adapters.sort_by_key(|adapter| {
        let info = adapter.get_info();
        let rank = match info.device_type {
            wgpu::DeviceType::DiscreteGpu => 0,
            wgpu::DeviceType::IntegratedGpu => 1,
            wgpu::DeviceType::VirtualGpu => 2,
            wgpu::DeviceType::Other => 3,
            wgpu::DeviceType::Cpu => 4,
        };
        (rank, info.backend == wgpu::Backend::Gl)
    });
    adapters
}

/// What to ask an adapter for: the usual limits with larger textures and buffers, and never more than it has.
pub fn device_descriptor(adapter: &wgpu::Adapter) -> wgpu::DeviceDescriptor<'static> {
    let wanted = wgpu::Limits {
        max_texture_dimension_2d: WANTED_TEXTURE_SIDE,
        max_buffer_size: WANTED_BUFFER_BYTES,
        ..wgpu::Limits::default()
    };
    wgpu::DeviceDescriptor {
        label: Some("sixfold"),
        required_features: adapter.features() & OPTIONAL_FEATURES,
        required_limits: wanted.or_worse_values_from(&adapter.limits()),
        ..Default::default()
    }
}

/// The value behind a lock; a thread that panicked while holding it leaves a string that is still a string.
fn locked<T>(mutex: &Mutex<T>) -> std::sync::MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}
