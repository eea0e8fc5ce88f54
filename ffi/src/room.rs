//! Where the parts of an open scene are in the caller's memory.

use crate::{HALFLIGHT_ALIGNMENT, HalflightScene, HalflightStatus};
use core::alloc::{Layout, LayoutError};
use core::mem::MaybeUninit;
use core::slice;
use halflight::bsdf::{AnyBsdf, TwoSided};
use halflight::light::AnyLight;
use halflight::stored::{NO_LIGHT, NO_MATERIAL, StoredScene};

type Light = AnyLight<'static>;
type Surface = TwoSided<AnyBsdf>;

const _: () = assert!(align_of::<HalflightScene>() <= HALFLIGHT_ALIGNMENT);
const _: () = assert!(align_of::<Light>() <= HALFLIGHT_ALIGNMENT);
const _: () = assert!(align_of::<Surface>() <= HALFLIGHT_ALIGNMENT);

/// The scene comes first, then its lights and its materials.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Places {
    lights: (usize, usize),
    materials: (usize, usize),
    /// All of it (bytes).
    pub(crate) size: usize,
}

impl Places {
    /// The places for a scene.
    pub(crate) fn of(stored: &StoredScene<'_>) -> Result<Self, HalflightStatus> {
        Self::for_room(stored.room()).map_err(|_| HalflightStatus::Damaged)
    }

    fn for_room((lights, materials): (usize, usize)) -> Result<Self, LayoutError> {
        let (layout, light) = Layout::new::<HalflightScene>().extend(Layout::array::<Light>(lights)?)?;
        let (layout, material) = layout.extend(Layout::array::<Surface>(materials)?)?;
        Ok(Self { lights: (light, lights), materials: (material, materials), size: layout.size() })
    }

    /// Opens a scene in memory.
    ///
    /// # Safety
    /// From `memory`, which `HALFLIGHT_ALIGNMENT` divides, `size` bytes must be there for writing, and
    /// nobody else may use them as long as the scene is used.
    pub(crate) unsafe fn open(
        self,
        stored: &StoredScene<'static>,
        memory: *mut u8,
    ) -> Result<*const HalflightScene, HalflightStatus> {
        // SAFETY: `size` covers both tables, which do not overlap, and their offsets have the alignment of
        // their entries, as `Layout` has computed them.
        let (lights, materials) = unsafe {
            (
                filled(memory.add(self.lights.0).cast(), self.lights.1, NO_LIGHT),
                filled(memory.add(self.materials.0).cast(), self.materials.1, NO_MATERIAL),
            )
        };
        let scene = stored.scene(lights, materials)?;
        let opened = HalflightScene { scene, camera: stored.camera()?, film: stored.film()? };
        let place = memory.cast::<HalflightScene>();
        // SAFETY: the scene is at the beginning, where there is room for it, and is aligned.
        unsafe { place.write(opened) };
        Ok(place)
    }
}

/// Memory as so many values.
///
/// # Safety
/// There must be aligned memory for them that nobody else uses.
unsafe fn filled<T: Copy + 'static>(place: *mut MaybeUninit<T>, count: usize, value: T) -> &'static mut [T] {
    // SAFETY: memory of any content is a `MaybeUninit`; that it is there is what the caller promises.
    let room = unsafe { slice::from_raw_parts_mut(place, count) };
    room.fill(MaybeUninit::new(value));
    // SAFETY: the same memory, all of whose values have just been written.
    unsafe { slice::from_raw_parts_mut(place.cast(), count) }
}
