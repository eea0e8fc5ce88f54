//! Pointers, lengths and bytes that are wrong come back as a status.

use crate::{Buffer, stored};
use halflight_ffi::{
    HalflightFacts, HalflightIrradiance, HalflightRadiance, HalflightScene, HalflightStatus as Status,
    halflight_irradiance, halflight_message, halflight_pixel, halflight_ray, halflight_scene_facts,
    halflight_scene_open, halflight_scene_room, halflight_visibility,
};
use std::ffi::CStr;
use std::ptr::{null, null_mut};

/// Memory for the tests' scene.
const ROOM: usize = 1 << 16;

/// How opening ends, with that much memory from `start` on, a multiple of 16 and some more.
fn opened(
    bytes: &[u8],
    memory: &mut Buffer,
    start: usize,
    room: usize,
) -> Result<*const HalflightScene, Status> {
    let mut scene = null();
    let memory = memory.bytes_mut()[start..].as_mut_ptr().cast();
    // SAFETY: the bytes are there, and so is the memory.
    let status = unsafe { halflight_scene_open(bytes.as_ptr(), bytes.len(), memory, room, &mut scene) };
    if status == Status::Ok { Ok(scene) } else { Err(status) }
}

fn room(bytes: &[u8]) -> Result<usize, Status> {
    let mut room = 0;
    // SAFETY: the bytes are there.
    let status = unsafe { halflight_scene_room(bytes.as_ptr(), bytes.len(), &mut room) };
    if status == Status::Ok { Ok(room) } else { Err(status) }
}

#[test]
fn room_is_as_much_as_is_needed() {
    let (bytes, mut memory) = (Buffer::new(&stored()), Buffer::new(&[0xa5; ROOM]));
    let room = room(bytes.bytes()).unwrap();
    assert!(room < ROOM);
    assert_eq!(opened(bytes.bytes(), &mut memory, 0, room - 1), Err(Status::Room));
    assert_eq!(opened(bytes.bytes(), &mut memory, 0, 0), Err(Status::Room));
    for start in [1, 4, 8] {
        assert_eq!(opened(bytes.bytes(), &mut memory, start, room), Err(Status::Misaligned));
    }
    assert!(memory.bytes().iter().all(|&b| b == 0xa5), "what is refused writes nothing");
    assert!(opened(bytes.bytes(), &mut memory, 0, room).is_ok());
    assert!(memory.bytes()[room..].iter().all(|&b| b == 0xa5), "nothing is written beyond the room");
}

#[test]
fn bytes_that_are_cut_changed_or_moved_are_refused() {
    let (mut bytes, mut memory) = (Buffer::new(&stored()), Buffer::new(&[0; ROOM]));
    let all = bytes.bytes().len();
    for length in [0, 1, 143, 144, all / 2, all - 4, all - 1] {
        let refused = opened(&bytes.bytes()[..length], &mut memory, 0, ROOM);
        assert!(matches!(refused, Err(Status::Damaged | Status::NotAScene)), "{length}: {refused:?}");
    }
    for place in (0..all).step_by(7) {
        bytes.bytes_mut()[place] ^= 0x41;
        let refused = opened(bytes.bytes(), &mut memory, 0, ROOM);
        assert!(refused.is_err(), "byte {place} may be anything");
        bytes.bytes_mut()[place] ^= 0x41;
    }
    let moved = Buffer::new(&[&[0; 4], bytes.bytes()].concat());
    assert_eq!(opened(&moved.bytes()[4..], &mut memory, 0, ROOM), Err(Status::Misaligned));
    assert!(opened(bytes.bytes(), &mut memory, 0, ROOM).is_ok());
}

#[test]
fn nothing_is_done_without_pointers() {
    let (bytes, mut memory) = (Buffer::new(&stored()), Buffer::new(&[0; ROOM]));
    let scene = opened(bytes.bytes(), &mut memory, 0, ROOM).unwrap();
    let (start, length) = (bytes.bytes().as_ptr(), bytes.bytes().len());
    let (v, mut room, mut out) = ([1.0_f32; 3].as_ptr(), 0, null());
    let mut number = 0.0;
    // SAFETY: every pointer is null or good.
    let statuses = unsafe {
        [
            halflight_scene_room(null(), length, &mut room),
            halflight_scene_room(start, length, null_mut()),
            halflight_scene_open(null(), length, null_mut(), ROOM, &mut out),
            halflight_scene_open(start, length, null_mut(), ROOM, &mut out),
            halflight_scene_facts(scene, null_mut::<HalflightFacts>()),
            halflight_irradiance(scene, v, v, 1, 0, null_mut::<HalflightIrradiance>()),
            halflight_visibility(scene, v, null(), 0, 1, 0, &mut number),
            halflight_visibility(null(), v, v, 0, 1, 0, &mut number),
            halflight_ray(scene, null(), v, 1, 0, null_mut::<HalflightRadiance>()),
            halflight_pixel(scene, 0, 0, 1, 0, null_mut()),
        ]
    };
    assert_eq!(statuses, [Status::Null; 10]);
    assert!(out.is_null() && room == 0 && number == 0.0);
}

#[test]
fn numbers_out_of_range_are_refused() {
    let (bytes, mut memory) = (Buffer::new(&stored()), Buffer::new(&[0; ROOM]));
    let scene = opened(bytes.bytes(), &mut memory, 0, ROOM).unwrap();
    let mut radiance = HalflightRadiance { mean: [-1.0; 3], standard_error: [-1.0; 3] };
    let mut ask = |origin: [f32; 3], toward: [f32; 3], samples| {
        // SAFETY: the scene is open, the arrays are there.
        unsafe { halflight_ray(scene, origin.as_ptr(), toward.as_ptr(), samples, 0, &mut radiance) }
    };
    let eye = [0.278, 0.273, -0.8];
    assert_eq!(ask(eye, [0.0, 0.0, 1.0], 0), Status::Argument);
    assert_eq!(ask(eye, [0.0; 3], 1), Status::Argument);
    assert_eq!(ask(eye, [f32::NAN, 0.0, 1.0], 1), Status::Argument);
    assert_eq!(ask([f32::INFINITY; 3], [0.0, 0.0, 1.0], 1), Status::Argument);
    assert_eq!(ask(eye, [0.0, 0.0, 3.0], 4), Status::Ok);
    assert!(radiance.mean.iter().all(|&l| l >= 0.0));
    // SAFETY: the scene is open; what is not aligned is not looked at.
    let crooked = unsafe {
        let off = eye.as_ptr().byte_add(1);
        halflight_ray(scene, off, off, 4, 0, &mut radiance)
    };
    assert_eq!(crooked, Status::Misaligned);
    let (mut seen, p, n) = (0.0, eye.as_ptr(), [0.0, 1.0, 0.0_f32]);
    // SAFETY: the scene is open, the arrays are there.
    let status = unsafe { halflight_visibility(scene, p, n.as_ptr(), 99, 4, 0, &mut seen) };
    assert_eq!(status, Status::NoLight);
    // SAFETY: the scene is open.
    let outside = unsafe { halflight_pixel(scene, 16, 0, 4, 0, &mut radiance) };
    assert_eq!(outside, Status::Argument);
}

#[test]
fn every_status_has_a_message() {
    let text = |status| {
        // SAFETY: messages are texts of static duration.
        unsafe { CStr::from_ptr(halflight_message(status)) }.to_str().unwrap()
    };
    let known: Vec<_> = (0..=8).map(text).collect();
    assert!(known.iter().all(|t| !t.is_empty() && *t != text(9)));
    assert_eq!((text(Status::Ok as u32), text(u32::MAX)), ("all is well", text(9)));
    assert!(text(Status::NoLight as u32).contains("no such light"));
}
