//! Rays through a tree of many triangles, one by one on one thread, and the building of the tree.
//!
//! ```text
//! cargo bench -p halflight-tests --bench rays
//! ```
//!
//! Three sets of rays: `camera` rays, side by side; `shadow` rays from what those meet toward points of a
//! lamp; `diffuse` rays from there into all directions. With `HALFLIGHT_RAYS=FOLDER` the triangles and rays
//! are also written, for `tests/peers/rays.sh`, which runs the same through Embree; `HALFLIGHT_SCENE=FILE`
//! takes the triangles and the camera of a scene file.

use criterion::{Criterion, Throughput};
use halflight::build::{Description, SceneBuffers};
use halflight::geom::{Frame, PreparedRay, Ray, offset_origin};
use halflight::glam::Vec3;
use halflight::scene::AnyScene;
use halflight::shape::{AnyShape, Shape, SurfacePoint};
use halflight::warp;
use halflight_tests::random::Uniforms;
use halflight_tests::scenes::bumpy_ground;
use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

/// Camera rays, in rows and columns.
const SIDE: u32 = 512;

/// A ray and how far it is followed (m).
type Reaching = (Ray, f32);

fn main() {
    let mut criterion = Criterion::default()
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(3))
        .sample_size(10)
        .configure_from_args();
    let start = Instant::now();
    let (buffers, camera) = stage();
    let built = start.elapsed().as_secs_f64();
    let bound = buffers.bind();
    let scene = bound.scene();
    let triangles = scene.surfaces().len();
    let bytes = size_of_val(scene.bvh().nodes()) + size_of_val(scene.surfaces());
    println!(
        "{triangles} triangles: read and built in {built:.2} s, {} bytes for each",
        bytes / triangles.max(1)
    );
    let sets = sets(&scene, &camera);
    if let Some(folder) = std::env::var_os("HALFLIGHT_RAYS") {
        write(Path::new(&folder), &scene, &sets).expect("a folder to write to");
    }
    for (name, rays) in &sets {
        measure(&mut criterion, &scene, name, rays);
    }
}

/// What is rendered, and its camera rays.
fn stage() -> (SceneBuffers, Vec<Reaching>) {
    let Some(file) = std::env::var_os("HALFLIGHT_SCENE") else {
        let eye = Vec3::new(0.3, 0.9, 1.6);
        let view = Frame::from_normal((Vec3::ZERO - eye).normalize());
        let ray = |x: f32, y: f32| {
            (Ray::new(eye, view.to_world(Vec3::new(0.5 * x, 0.5 * y, 1.0).normalize())), f32::INFINITY)
        };
        return (bumpy_ground(616), raster(ray));
    };
    let loaded = halflight::load::load(Path::new(&file), &Default::default()).expect("a scene");
    let description: &Description = &loaded.description;
    let camera = description.camera.camera(description.width, description.height).expect("a camera");
    (SceneBuffers::new(description).expect("a proper scene"), raster(|x, y| camera.ray(x, y)))
}

/// Rays through the middles of pixels.
fn raster(ray: impl Fn(f32, f32) -> Reaching) -> Vec<Reaching> {
    let at = |i: u32| (2.0 * i as f32 + 1.0) / SIDE as f32 - 1.0;
    (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))).map(|(x, y)| ray(at(x), -at(y))).collect()
}

/// The three sets of rays.
fn sets(scene: &AnyScene<'_>, camera: &[Reaching]) -> [(&'static str, Vec<Reaching>); 3] {
    let bounds = scene.bvh().bounds();
    let middle = 0.5 * (bounds.min + bounds.max);
    let size = 0.25 * (bounds.max - bounds.min).max_element();
    let mut random = Uniforms::new(41);
    let (mut shadow, mut diffuse) = (Vec::new(), Vec::new());
    for (ray, reach) in camera {
        let Some(hit) = scene.closest_hit(ray, *reach) else { continue };
        let at = &hit.at;
        let normal = if at.normal.dot(ray.direction) > 0.0 { -at.normal } else { at.normal };
        let [u, v] = random.two();
        let lamp = Vec3::new(middle.x + size * (u - 0.5), bounds.max.y + size, middle.z + size * (v - 0.5));
        let away = leaving(at, (lamp - at.point).normalize());
        if normal.dot(away.direction) > 0.0 {
            shadow.push((away, away.origin.distance(lamp)));
        }
        let wi = Frame::from_normal(normal).to_world(warp::cosine_hemisphere(random.two()));
        diffuse.push((leaving(at, wi), f32::INFINITY));
    }
    [("camera", camera.to_vec()), ("shadow", shadow), ("diffuse", diffuse)]
}

fn leaving(at: &SurfacePoint, wi: Vec3) -> Ray {
    Ray::new(offset_origin(at.point, at.error, at.normal, wi), wi)
}

/// Nearest hit and any hit of each ray of a set.
fn measure(criterion: &mut Criterion, scene: &AnyScene<'_>, name: &str, rays: &[Reaching]) {
    let meets = |(ray, reach): &&Reaching| scene.closest_hit(ray, *reach).is_some();
    println!("{name}: {} rays, {} meet something", rays.len(), rays.iter().filter(meets).count());
    let mut group = criterion.benchmark_group(name);
    group.throughput(Throughput::Elements(rays.len() as u64));
    group.bench_function("closest", |bencher| {
        bencher.iter(|| rays.iter().filter(|ray| meets(black_box(ray))).count());
    });
    group.bench_function("any", |bencher| {
        bencher.iter(|| rays.iter().filter(|(ray, reach)| blocked(scene, black_box(ray), *reach)).count());
    });
    group.finish();
}

/// True when a ray meets anything.
fn blocked(scene: &AnyScene<'_>, ray: &Ray, reach: f32) -> bool {
    let prepared = PreparedRay::new(*ray);
    let meets = |i: u32| scene.surfaces()[i as usize].shape.intersect(&prepared, reach).is_some();
    scene.bvh().any_hit(&prepared, reach, meets)
}

/// Writes triangles and rays as little-endian `f32`: nine numbers for a triangle; origin, direction and
/// reach for a ray.
fn write(folder: &Path, scene: &AnyScene<'_>, sets: &[(&str, Vec<Reaching>)]) -> std::io::Result<()> {
    std::fs::create_dir_all(folder)?;
    let bytes = |numbers: Vec<f32>| numbers.into_iter().flat_map(f32::to_le_bytes).collect::<Vec<u8>>();
    let corners = scene.surfaces().iter().flat_map(|surface| match &surface.shape {
        AnyShape::Triangle(triangle) => triangle.corners().to_vec(),
        AnyShape::Rectangle(rectangle) => {
            let corner =
                |u: f32, v: f32| rectangle.centre() + rectangle.half_u() * u + rectangle.half_v() * v;
            let [a, b, c, d] = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
            vec![a, b, c, a, c, d]
        }
        // Nothing that is a few triangles.
        _ => Vec::new(),
    });
    let triangles = corners.flat_map(|corner| corner.to_array()).collect();
    std::fs::write(folder.join("triangles.bin"), bytes(triangles))?;
    for (name, rays) in sets {
        let numbers = rays.iter().flat_map(|(ray, reach)| {
            let (o, d) = (ray.origin, ray.direction);
            [o.x, o.y, o.z, d.x, d.y, d.z, *reach]
        });
        std::fs::write(folder.join(format!("{name}.bin")), bytes(numbers.collect()))?;
    }
    Ok(())
}
