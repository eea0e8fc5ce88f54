use super::*;
use crate::num::{hash2, unit_f32};
use crate::shape::{Cylinder, Disk, Rectangle, Shape, Sphere, Triangle};
use glam::{Mat3, Vec3};
use std::vec::Vec;

/// The numbers 1 to 6 in two rows, in the green channel.
const SIX: [Rgb; 6] = [
    Rgb::new(0.0, 1.0, 0.0),
    Rgb::new(0.0, 2.0, 0.0),
    Rgb::new(0.0, 3.0, 0.0),
    Rgb::new(0.0, 4.0, 0.0),
    Rgb::new(0.0, 5.0, 0.0),
    Rgb::new(0.0, 6.0, 0.0),
];

fn six(interpolation: Interpolation, wrap: Wrap) -> Texture<'static> {
    let kind = Kind::Picture { width: 3, height: 2, interpolation, wrap };
    Texture::new(kind.into(), Texels::Float(&SIX)).unwrap()
}

#[test]
fn lookups_are_those_of_mitsuba() {
    let places = [
        [0.01, 0.01],
        [0.99, 0.01],
        [0.01, 0.99],
        [0.5, 0.5],
        [0.2, 0.8],
        [1.1, 0.3],
        [-0.1, 0.3],
        [2.3, -1.4],
        [1.0, 1.0],
        [0.0, 0.0],
    ];
    // From Mitsuba 3.9.1.
    let nearest = [
        (Wrap::Repeat, [1.0, 3.0, 4.0, 5.0, 4.0, 1.0, 3.0, 4.0, 1.0, 1.0]),
        (Wrap::Mirror, [1.0, 3.0, 4.0, 5.0, 4.0, 3.0, 1.0, 4.0, 6.0, 1.0]),
        (Wrap::Clamp, [1.0, 3.0, 4.0, 5.0, 4.0, 3.0, 1.0, 3.0, 6.0, 1.0]),
    ];
    let bilinear = [
        (Wrap::Repeat, [3.38, 3.5, 3.5, 3.5, 3.8, 1.7, 2.9, 3.5, 3.5, 3.5]),
        (Wrap::Mirror, [1.0, 3.0, 4.0, 3.5, 4.1, 3.3, 1.3, 3.5, 6.0, 1.0]),
        (Wrap::Clamp, [1.0, 3.0, 4.0, 3.5, 4.1, 3.3, 1.3, 3.0, 6.0, 1.0]),
    ];
    for (interpolation, expected) in [(Interpolation::Nearest, nearest), (Interpolation::Bilinear, bilinear)]
    {
        for (wrap, values) in expected {
            for (place, value) in places.into_iter().zip(values) {
                let found = six(interpolation, wrap).at(place.into()).g;
                assert!(
                    (found - value).abs() < 2e-6,
                    "{interpolation:?} {wrap:?} {place:?}: {found} {value}"
                );
            }
        }
    }
}

#[test]
fn the_middle_of_a_texel_is_its_value_and_seams_are_blends() {
    for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
        for (index, value) in SIX.iter().enumerate() {
            let middle = Vec2::new((index % 3) as f32 + 0.5, (index / 3) as f32 + 0.5) / Vec2::new(3.0, 2.0);
            let found = six(Interpolation::Bilinear, wrap).at(middle).g;
            assert!((found - value.g).abs() < 2e-6, "{wrap:?} {index} {found}");
        }
    }
    let seam = |wrap| six(Interpolation::Bilinear, wrap).at(Vec2::new(1.0, 0.25)).g;
    assert_eq!([Wrap::Repeat, Wrap::Mirror, Wrap::Clamp].map(seam), [2.0, 3.0, 3.0]);
}

#[test]
fn whatever_the_coordinates_values_stay_between_the_texels() {
    let hard =
        [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e38, -1e38, 1e9, -3e9, -1e-30, 1e-45, -0.0, 8388609.0];
    let random = |i: u32, j| (unit_f32(hash2(i, j)) - 0.5) * num_scale(i);
    let pairs: Vec<[f32; 2]> = hard
        .iter()
        .flat_map(|a| hard.iter().map(|b| [*a, *b]))
        .chain((0..20_000).map(|i| [random(i, 1), random(i, 2)]))
        .collect();
    let to_uv = UvTransform::new([[3.0, -1e30, 0.5], [0.1, 7.0, -1e20]]).unwrap();
    for interpolation in [Interpolation::Nearest, Interpolation::Bilinear] {
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            let plain = six(interpolation, wrap);
            let turned = Texture::new(plain.pattern().with_transform(to_uv), Texels::Float(&SIX)).unwrap();
            for uv in &pairs {
                for texture in [plain, turned] {
                    let found = texture.at((*uv).into()).g;
                    assert!(
                        (1.0 - 1e-6..=6.0 + 1e-5).contains(&found),
                        "{interpolation:?} {wrap:?} {uv:?}: {found}"
                    );
                }
            }
        }
    }
    fn num_scale(i: u32) -> f32 {
        [2.0, 20.0, 1e4, 1e8][i as usize % 4]
    }
}

#[test]
fn a_single_texel_is_the_same_everywhere() {
    let one = [[255, 0, 51]];
    for texels in [Texels::Linear8(&one), Texels::Float(&[Rgb::new(1.0, 0.0, 0.2)])] {
        for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
            let interpolation = Interpolation::Bilinear;
            let kind = Kind::Picture { width: 1, height: 1, interpolation, wrap };
            let texture = Texture::new(kind.into(), texels).unwrap();
            for x in [-0.7, 0.0, 0.3, 0.5, 1.0, 7.9, f32::NAN] {
                let found = texture.at(Vec2::new(x, 1.0 - x));
                assert!((found.r - 1.0).abs() < 1e-6 && found.g == 0.0 && (found.b - 0.2).abs() < 1e-6);
            }
        }
    }
}

#[test]
fn eight_bits_are_decoded_before_they_are_blended() {
    let codes = [[0, 0, 0], [255, 128, 55]];
    let at = |texels| Texture::picture(texels, 2, 1).unwrap().at(Vec2::new(0.5, 0.0));
    let (srgb, linear) = (at(Texels::Srgb8(&codes)), at(Texels::Linear8(&codes)));
    assert!((srgb.r - 0.5).abs() < 1e-6 && (srgb.g - 0.5 * 0.215_860_5).abs() < 1e-6);
    assert!((linear.g - 0.5 * 128.0 / 255.0).abs() < 1e-6 && (linear.b - 0.5 * 55.0 / 255.0).abs() < 1e-6);
}

#[test]
fn checkerboards_are_those_of_mitsuba() {
    let kind = Kind::Checkerboard([Rgb::splat(0.4), Rgb::splat(0.2)]);
    let texture = Texture::new(kind.into(), Texels::NONE).unwrap();
    for ([u, v], value) in [
        ([0.1, 0.1], 0.4),
        ([0.6, 0.1], 0.2),
        ([0.6, 0.6], 0.4),
        ([0.5, 0.1], 0.4),
        ([-0.1, 0.1], 0.2),
        ([1.0, 1.0], 0.4),
        ([f32::NAN, f32::INFINITY], 0.4),
    ] {
        assert_eq!(texture.at(Vec2::new(u, v)).r, value, "{u} {v}");
    }
    assert!((texture.mean().g - 0.3).abs() < 1e-7);
    assert_eq!((texture.largest().g, texture.smallest().g), (0.4, 0.2));
}

#[test]
fn bad_textures_are_refused_with_the_texel() {
    let mut texels = SIX;
    assert_eq!(
        Texture::picture(Texels::Float(&texels), 3, 3),
        Err(TextureError::Count { width: 3, height: 3, texels: 6 })
    );
    assert!(matches!(Texture::picture(Texels::NONE, 0, 5), Err(TextureError::Count { .. })));
    for bad in [f32::NAN, f32::INFINITY, -0.1] {
        texels[4].b = bad;
        let error = Texture::picture(Texels::Float(&texels), 3, 2).unwrap_err();
        assert!(matches!(error, TextureError::Value { place: Some([1, 1]), .. }), "{error}");
    }
    assert!(UvTransform::new([[1.0, 0.0, f32::NAN], [0.0; 3]]).is_err());
}

/// A shape's own coordinates, and those after a transform of the unit shape, from Mitsuba 3.9.1.
#[test]
fn shapes_have_the_coordinates_of_mitsuba() {
    let close = |found: Vec2, expected: [f32; 2]| {
        assert!((found - Vec2::from(expected)).abs().max_element() < 2e-5, "{found} {expected:?}");
    };
    let own = |shape: &dyn Fn(Vec3) -> Vec2, p: [f32; 3], uv| close(shape(p.into()), uv);
    let rectangle = Rectangle::new(Vec3::ZERO, Vec3::X, Vec3::Y).unwrap();
    own(&|p| SurfaceUvs::Own.at(&rectangle, p), [0.5, -0.2, 0.0], [0.75, 0.4]);
    let disk = Disk::new(Vec3::ZERO, Vec3::X, Vec3::Y).unwrap();
    own(&|p| SurfaceUvs::Own.at(&disk, p), [0.5, -0.2, 0.0], [0.538_52, 0.939_44]);
    own(&|p| SurfaceUvs::Own.at(&disk, p), [-0.5, 0.2, 0.0], [0.538_52, 0.439_44]);
    let sphere = Sphere::new(Vec3::ZERO, 1.0).unwrap();
    let on = |p: Vec3| SurfaceUvs::Own.at(&sphere, p.normalize());
    own(&on, [3.0, 0.3, 0.2], [0.015_86, 0.478_92]);
    own(&on, [-3.0, 0.3, 0.2], [0.484_14, 0.478_92]);
    own(&on, [0.1, 0.2, 3.0], [0.176_21, 0.023_68]);
    own(&on, [0.1, -3.0, -0.5], [0.755_3, 0.552_54]);
    let tube = Cylinder::new(Vec3::NEG_Y, Vec3::Y * 2.0, 0.8).unwrap();
    own(&|p| SurfaceUvs::Own.at(&tube, p), [0.774_597, 0.3, 0.2], [0.959_78, 0.65]);
    let triangle = Triangle::new(Vec3::ZERO, Vec3::X, Vec3::X + Vec3::Y).unwrap();
    own(&|p| SurfaceUvs::Own.at(&triangle, p), [0.7, 0.2, 0.0], [0.5, 0.2]);
    // Turned by 90° about x.
    let to_object = Mat3::from_cols(Vec3::X, Vec3::NEG_Z, Vec3::Y);
    let space = SurfaceUvs::Object(ObjectSpace { origin: Vec3::ZERO, to_object });
    close(space.at(&sphere, Vec3::new(3.0, 0.3, 0.2).normalize()), [0.010_59, 0.531_66]);
}

#[test]
fn coordinates_of_shapes_are_finite_at_their_poles_and_seams() {
    let sphere = Sphere::new(Vec3::ZERO, 1.0).unwrap();
    for n in
        [Vec3::Z, Vec3::NEG_Z, Vec3::X, Vec3::NEG_X, Vec3::new(1.0, -1e-30, 0.0), Vec3::new(1.0, -0.0, 0.0)]
    {
        let uv = sphere.uv(n);
        assert!((0.0..=1.0).contains(&uv.x) && (0.0..=1.0).contains(&uv.y), "{n} {uv}");
    }
    let disk = Disk::new(Vec3::ZERO, Vec3::X, Vec3::Y).unwrap();
    assert_eq!(disk.uv(Vec3::ZERO), Vec2::ZERO);
}
