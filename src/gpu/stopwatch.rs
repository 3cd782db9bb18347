//! How long a device takes: by its own stamps where it has them and they can be believed, else by many dispatches.

use std::time::{Duration, Instant};

use super::{Gpu, GpuError};
use crate::mapping::DeviceTime;

/// Shortest time that the processor's clock takes, so that the way to the device, a tenth of a millisecond, does not count.
const SHORTEST_BY_CLOCK: Duration = Duration::from_millis(2);
/// Most dispatches in a pass.
const MOST_DISPATCHES: f64 = 4096.0;
/// Stamps of a sample: where the work begins and ends, then the copy.
const STAMPS: u32 = 4;
/// Stamps that add up to less than this part of what the processor's clock says are those of a driver that counts something else.
const BELIEVED_FROM: f64 = 0.25;

/// Work for a device.
pub(super) trait Timed {
    /// Encodes the work so many times, with stamps before the first and after the last.
    fn encode(&self, encoder: &mut wgpu::CommandEncoder, times: u32, stamps: Option<StampPair<'_>>);
}

/// Two places in a set of queries: where the work begins and where it ends.
#[derive(Clone, Copy)]
pub(super) struct StampPair<'a> {
    pub queries: &'a wgpu::QuerySet,
    pub begin: u32,
    pub end: u32,
}

/// Times passes on one device.
pub(super) struct Stopwatch<'a> {
    gpu: &'a Gpu,
    stamps: Option<Stamps>,
}

/// Where stamps are written and read.
struct Stamps {
    queries: wgpu::QuerySet,
    resolved: wgpu::Buffer,
    read_back: wgpu::Buffer,
}

impl Stamps {
    const BYTES: u64 = (STAMPS as usize * size_of::<u64>()) as u64;

    fn new(gpu: &Gpu) -> Result<Option<Self>, GpuError> {
        if !gpu
            .device
            .features()
            .contains(wgpu::Features::TIMESTAMP_QUERY)
        {
            return Ok(None);
        }
        gpu.checked(|device| {
            let buffer = |label, usage| {
                device.create_buffer(&wgpu::BufferDescriptor {
                    label: Some(label),
                    size: Self::BYTES,
                    usage,
                    mapped_at_creation: false,
                })
            };
            let resolved = wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC;
            let read = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
            Some(Self {
                queries: device.create_query_set(&wgpu::QuerySetDescriptor {
                    label: Some("stamps"),
                    ty: wgpu::QueryType::Timestamp,
                    count: STAMPS,
                }),
                resolved: buffer("stamps", resolved),
                read_back: buffer("stamps read back", read),
            })
        })
    }
}

impl<'a> Stopwatch<'a> {
    pub fn new(gpu: &'a Gpu) -> Result<Self, GpuError> {
        let stamps = Stamps::new(gpu)?;
        Ok(Self { gpu, stamps })
    }

    /// Nanoseconds of the work and of what it is compared with, one after the other, as often as `samples` says.
    pub fn time(
        &mut self,
        [work, copy]: [&dyn Timed; 2],
        samples: usize,
        shortest: Duration,
    ) -> Result<Vec<DeviceTime>, GpuError> {
        // The first run may still compile.
        self.by_clock(work, 1)?;
        self.by_clock(copy, 1)?;
        let once = self.by_clock(work, 1)?;
        let times = |shortest: Duration| {
            (shortest.as_nanos() as f64 / once)
                .clamp(1.0, MOST_DISPATCHES)
                .ceil() as u32
        };
        let by_clock = times(shortest.max(SHORTEST_BY_CLOCK));
        if self.stamps.is_some() {
            let start = Instant::now();
            let found = self.by_stamps([work, copy], by_clock)?;
            let clock = start.elapsed().as_secs_f64() * 1e9 / f64::from(by_clock);
            let stamped = found.map_or(0.0, |time| time.work_ns + time.copy_ns);
            if stamped < BELIEVED_FROM * clock || stamped > clock {
                self.stamps = None;
            }
        }
        let by_stamps = times(shortest);
        (0..samples.max(1))
            .map(|_| match self.by_stamps([work, copy], by_stamps)? {
                Some(time) => Ok(time),
                None => Ok(DeviceTime {
                    work_ns: self.by_clock(work, by_clock)?,
                    copy_ns: self.by_clock(copy, by_clock)?,
                }),
            })
            .collect()
    }

    /// By the device's own stamps; `None` where there are none.
    fn by_stamps(
        &self,
        works: [&dyn Timed; 2],
        times: u32,
    ) -> Result<Option<DeviceTime>, GpuError> {
        let Some(Stamps {
            queries,
            resolved,
            read_back,
        }) = &self.stamps
        else {
            return Ok(None);
        };
        self.gpu.checked(|device| {
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor {
                label: Some("timed"),
            });
            for (work, begin) in works.into_iter().zip([0, 2]) {
                let stamps = StampPair {
                    queries,
                    begin,
                    end: begin + 1,
                };
                work.encode(&mut encoder, times, Some(stamps));
            }
            encoder.resolve_query_set(queries, 0..STAMPS, resolved, 0);
            encoder.copy_buffer_to_buffer(resolved, 0, read_back, 0, Stamps::BYTES);
            self.gpu.queue.submit([encoder.finish()]);
        })?;
        let bytes = self.gpu.read_buffer(read_back, Stamps::BYTES)?;
        let stamps: Vec<u64> = bytemuck::pod_collect_to_vec(&bytes);
        let period = f64::from(self.gpu.queue.get_timestamp_period());
        let ns = |first: usize| {
            let [begin, end] = [first, first + 1].map(|k| stamps.get(k).copied().unwrap_or(0));
            end.saturating_sub(begin) as f64 * period / f64::from(times)
        };
        Ok(Some(DeviceTime {
            work_ns: ns(0),
            copy_ns: ns(2),
        }))
    }

    /// By the processor's clock.
    fn by_clock(&self, work: &dyn Timed, times: u32) -> Result<f64, GpuError> {
        let start = Instant::now();
        self.gpu.checked(|device| {
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor {
                label: Some("timed"),
            });
            work.encode(&mut encoder, times, None);
            self.gpu.queue.submit([encoder.finish()]);
        })?;
        self.gpu.wait()?;
        Ok(start.elapsed().as_secs_f64() * 1e9 / f64::from(times))
    }
}
