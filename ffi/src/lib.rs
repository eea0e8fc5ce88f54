//! halflight from C: scenes that are read from storage, and the light in them.
//!
//! A thin layer over [`halflight::stored`]: nothing is allocated, the scene's bytes stay where they are, and
//! what has to be taken out of them goes into memory of the caller. The header is `include/halflight.h`.
//!
//! This is the only crate of the workspace with unsafe code. What it needs it for are the pointers: each is
//! checked for null and for its alignment; that there are as many bytes as the caller says is the caller's
//! promise.
#![no_std]

#[cfg(feature = "std")]
extern crate std;

mod ask;
mod room;
mod status;

pub use ask::{
    HalflightIrradiance, HalflightRadiance, halflight_irradiance, halflight_pixel, halflight_ray,
    halflight_visibility,
};
pub use status::{HalflightStatus, halflight_message};

use core::ffi::c_void;
use core::slice;
use halflight::stored::{BorrowedScene, StoredScene};
use halflight::{Camera, Film};
use room::Places;

/// What divides the addresses of a scene's bytes and of the memory for it.
pub const HALFLIGHT_ALIGNMENT: usize = 16;

/// An open scene, in memory of the caller. It is read only: any number of threads may ask it.
#[derive(Debug)]
pub struct HalflightScene {
    scene: BorrowedScene<'static>,
    camera: Camera,
    film: Film,
}

/// What a scene holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(C)]
pub struct HalflightFacts {
    /// Columns of its picture.
    pub width: u32,
    /// Rows of its picture.
    pub height: u32,
    /// Lights.
    pub lights: u32,
    /// Surfaces.
    pub surfaces: u32,
}

/// The caller's bytes as a scene.
///
/// # Safety
/// There must be so many bytes, and they must not change as long as the scene is used.
unsafe fn stored(bytes: *const u8, length: usize) -> Result<StoredScene<'static>, HalflightStatus> {
    if bytes.is_null() {
        return Err(HalflightStatus::Null);
    }
    if length > isize::MAX as usize {
        return Err(HalflightStatus::Damaged);
    }
    // SAFETY: not null, not too long; the rest is the caller's promise.
    Ok(StoredScene::new(unsafe { slice::from_raw_parts(bytes, length) })?)
}

/// What a pointer of the caller points to.
///
/// # Safety
/// The pointer must be null, misaligned, or point to a value that does not change.
unsafe fn get<'a, T>(pointer: *const T) -> Result<&'a T, HalflightStatus> {
    if !pointer.is_aligned() {
        return Err(HalflightStatus::Misaligned);
    }
    // SAFETY: aligned; the rest is the caller's promise.
    unsafe { pointer.as_ref() }.ok_or(HalflightStatus::Null)
}

/// The status of a result, whose value goes to `out`.
///
/// # Safety
/// `out` must be null, misaligned, or have room for a value.
unsafe fn put<T>(out: *mut T, result: impl FnOnce() -> Result<T, HalflightStatus>) -> HalflightStatus {
    if out.is_null() {
        return HalflightStatus::Null;
    }
    if !out.is_aligned() {
        return HalflightStatus::Misaligned;
    }
    match result() {
        Ok(value) => {
            // SAFETY: not null, aligned; the rest is the caller's promise.
            unsafe { out.write(value) };
            HalflightStatus::Ok
        }
        Err(status) => status,
    }
}

/// Says how much memory a scene takes beside its bytes.
///
/// * `bytes`, `length` – of a scene as `halflight export SCENE --as bytes` writes it
/// * `room` – receives the number of bytes
///
/// # Safety
/// `bytes` must be null or point to `length` bytes, `room` must be null or point to a `size_t`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn halflight_scene_room(
    bytes: *const u8,
    length: usize,
    room: *mut usize,
) -> HalflightStatus {
    // SAFETY: as the caller promises.
    unsafe { put(room, || Ok(Places::of(&stored(bytes, length)?)?.size)) }
}

/// Checks a scene and opens it: once, before it is asked. There is nothing to close.
///
/// * `bytes`, `length` – as for `halflight_scene_room`; must stay as they are while the scene is used
/// * `memory`, `room` – as much as `halflight_scene_room` says, for nothing else while the scene is used
/// * `scene` – receives the open scene
///
/// # Safety
/// `bytes` must be null or point to `length` bytes, `memory` must be null or point to `room` bytes, `scene`
/// must be null or point to a pointer.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn halflight_scene_open(
    bytes: *const u8,
    length: usize,
    memory: *mut c_void,
    room: usize,
    scene: *mut *const HalflightScene,
) -> HalflightStatus {
    let open = || {
        // SAFETY: as the caller promises.
        let stored = unsafe { stored(bytes, length)? };
        let places = Places::of(&stored)?;
        if memory.is_null() {
            return Err(HalflightStatus::Null);
        }
        if !memory.addr().is_multiple_of(HALFLIGHT_ALIGNMENT) {
            return Err(HalflightStatus::Misaligned);
        }
        if room < places.size {
            return Err(HalflightStatus::Room);
        }
        // SAFETY: aligned, large enough, and the caller's promise to leave it alone.
        unsafe { places.open(&stored, memory.cast()) }
    };
    // SAFETY: as the caller promises.
    unsafe { put(scene, open) }
}

/// Says what a scene holds.
///
/// * `scene` – from `halflight_scene_open`
/// * `facts` – receives the answer
///
/// # Safety
/// `scene` must be null or open, `facts` must be null or point to a `HalflightFacts`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn halflight_scene_facts(
    scene: *const HalflightScene,
    facts: *mut HalflightFacts,
) -> HalflightStatus {
    let ask = || {
        // SAFETY: as the caller promises.
        let opened = unsafe { get(scene)? };
        Ok(HalflightFacts {
            width: opened.film.width(),
            height: opened.film.height(),
            lights: opened.scene.lights().len() as u32,
            surfaces: opened.scene.surfaces().len() as u32,
        })
    };
    // SAFETY: as the caller promises.
    unsafe { put(facts, ask) }
}
