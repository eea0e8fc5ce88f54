use super::*;
use halflight::Rgb;
use std::sync::Mutex;

const CROP: PixelRect = PixelRect { x0: 3, y0: 5, x1: 80, y1: 70 };

/// Each sample tells its pixel's place; a tile is good enough after one step.
struct Place<F>(F);

impl<F: Fn() + Sync> Work<PixelStats> for Place<F> {
    fn render(&self, rect: PixelRect, samples: Range<u32>, pixels: &mut [PixelStats]) -> DifferenceSums {
        (self.0)();
        let places = (rect.y0..rect.y1).flat_map(|y| (rect.x0..rect.x1).map(move |x| (x, y)));
        for ((x, y), pixel) in places.zip(pixels) {
            for _ in samples.clone() {
                pixel.add(Rgb::new(x as f32, y as f32, 0.0));
            }
        }
        DifferenceSums::default()
    }

    fn refine(
        &self,
        tile: &mut AdaptiveTile,
        _: &Target,
        pixels: &mut [PixelStats],
        go_on: &dyn Fn() -> bool,
    ) -> u64 {
        if !go_on() || pixels[0].count() > 0 {
            return 0;
        }
        self.render(tile.rect(), 0..1, pixels);
        pixels.len() as u64
    }
}

const PLACE: Place<fn()> = Place(|| {});

fn places_of(rendered: &Rendered<PixelStats>) -> Vec<[f32; 3]> {
    rendered.pixels(|p| p.mean().to_array())
}

fn expected() -> Vec<[f32; 3]> {
    (5..70).flat_map(|y| (3..80).map(move |x| [x as f32, y as f32, 0.0])).collect()
}

#[test]
fn every_pixel_is_rendered_in_its_place() {
    let rendered =
        render(CROP, Goal::Samples(5), (&AtomicBool::new(false), &Keeper::default()), &PLACE, &|_| {})
            .unwrap();
    assert_eq!(places_of(&rendered), expected());
    assert_eq!(rendered.samples_per_pixel(), (5, 5));
    assert_eq!(rendered.samples(), 77 * 65 * 5);
    assert!(!rendered.interrupted);
}

#[test]
fn every_pixel_is_refined_in_its_place() {
    let goal = Goal::Error { target: 0.1, most: 64, adaptive: true };
    let rendered =
        render(CROP, goal, (&AtomicBool::new(false), &Keeper::default()), &PLACE, &|_| {}).unwrap();
    assert_eq!(places_of(&rendered), expected());
    assert_eq!((rendered.samples(), rendered.missed), (77 * 65, 0));
}

#[test]
fn progress_adds_up_and_passes_come_in_order() {
    let (taken, ends) = (Mutex::new(0), Mutex::new(Vec::new()));
    let on_progress = |event| match event {
        Event::Samples(n) => *taken.lock().unwrap() += n,
        Event::Round { samples, .. } => ends.lock().unwrap().push(samples),
        Event::Resumed => panic!("there is no checkpoint"),
    };
    render::<PixelStats>(
        CROP,
        Goal::Samples(6),
        (&AtomicBool::new(false), &Keeper::default()),
        &PLACE,
        &on_progress,
    )
    .unwrap();
    assert_eq!(*taken.lock().unwrap(), 77 * 65 * 6);
    assert_eq!(*ends.lock().unwrap(), [1.0, 2.0, 4.0, 6.0]);
}

#[test]
fn an_interrupt_stops_after_the_first_sample_of_each_pixel() {
    let goals = [
        Goal::Samples(64),
        Goal::Error { target: 0.1, most: 64, adaptive: false },
        Goal::Error { target: 0.1, most: 64, adaptive: true },
    ];
    for goal in goals {
        let rendered =
            render(CROP, goal, (&AtomicBool::new(true), &Keeper::default()), &PLACE, &|_| {}).unwrap();
        assert!(rendered.interrupted);
        assert_eq!(rendered.samples_per_pixel(), (1, 1));
        assert_eq!(places_of(&rendered), expected());
    }
}

#[test]
fn an_interrupt_within_a_pass_keeps_what_was_done() {
    let stop = AtomicBool::new(false);
    let tiles = Mutex::new(0);
    let stop_early = Place(|| {
        *tiles.lock().unwrap() += 1;
        if *tiles.lock().unwrap() == 10 {
            stop.store(true, Ordering::Relaxed);
        }
    });
    let rendered =
        render(CROP, Goal::Samples(64), (&stop, &Keeper::default()), &stop_early, &|_| {}).unwrap();
    assert!(rendered.interrupted);
    assert_eq!(rendered.samples_per_pixel(), (1, 2));
    assert_eq!(places_of(&rendered).len(), CROP.area());
}
