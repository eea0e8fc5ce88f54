//! Pictures in a terminal, decoded as a terminal would.

use crate::support::Folder;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// Columns and rows.
const SIZE: (usize, usize) = (48, 32);

type Picture = Vec<[u8; 3]>;

/// The file that is written, and the last picture that is drawn meanwhile.
fn drawn(protocol: &str, decode: impl Fn(&str) -> Picture) -> (Picture, Picture) {
    let folder = Folder::new();
    let (width, height) = SIZE;
    let line = format!(
        "render scene.xml -o out.png --spp 16 --width {width} --height {height} --preview={protocol}"
    );
    let text = folder.good(&line);
    let written = image::open(folder.path("out.png")).unwrap().to_rgb8();
    let seen = decode(&text);
    assert_eq!(seen.len(), width * height, "{protocol}");
    (written.pixels().map(|p| p.0).collect(), seen)
}

/// Source: "Terminal graphics protocol", section "Remote client".
fn kitty(text: &str) -> Picture {
    let mut letters = String::new();
    for piece in text.split("\x1b_G").skip(1) {
        let (head, rest) = piece.split_once(';').unwrap();
        if head.starts_with("a=T,f=24") {
            assert!(head.contains(",s=48,v=32,"), "{head}");
            letters.clear();
        }
        letters += rest.split_once("\x1b\\").unwrap().0;
    }
    STANDARD.decode(letters).unwrap().as_chunks::<3>().0.to_vec()
}

/// A number and what follows it.
fn number(text: &str) -> (usize, &str) {
    let end = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
    (text[..end].parse().unwrap(), &text[end..])
}

/// Source: DEC 1989, "VT330/VT340 Programmer Reference Manual", volume 2, chapter 14.
fn sixel(text: &str) -> Picture {
    let (_, last) = text.rsplit_once("\x1bPq\"1;1;48;32").unwrap();
    let mut rest = last.split_once("\x1b\\").unwrap().0;
    let (mut x, mut top, mut count, mut colour) = (0, 0, 1, 0);
    let (mut palette, mut picture) = (vec![[0; 3]; 256], vec![[9; 3]; SIZE.0 * SIZE.1]);
    while let Some(letter) = rest.chars().next() {
        rest = &rest[1..];
        match letter {
            '#' => {
                (colour, rest) = number(rest);
                if let Some(levels) = rest.strip_prefix(";2;") {
                    rest = levels;
                    for level in &mut palette[colour] {
                        let (percent, after) = number(rest);
                        *level = (percent * 255 / 100) as u8;
                        rest = after.strip_prefix(';').unwrap_or(after);
                    }
                }
            }
            '!' => (count, rest) = number(rest),
            '$' => x = 0,
            '-' => (x, top) = (0, top + 6),
            '?'..='~' => {
                for (x, bit) in (x..x + count).flat_map(|x| (0..6).map(move |bit| (x, bit))) {
                    if (letter as u8 - b'?') >> bit & 1 == 1 {
                        picture[(top + bit) * SIZE.0 + x] = palette[colour];
                    }
                }
                (x, count) = (x + count, 1);
            }
            other => panic!("{other:?} is no sixel"),
        }
    }
    picture
}

/// Half blocks: the upper pixel in the letter's colour, the lower one behind it.
fn blocks(text: &str) -> Picture {
    let last = text.rsplit("\x1b7").next().unwrap();
    let mut picture = vec![[9; 3]; SIZE.0 * SIZE.1];
    for (row, line) in last.split("\x1b[0m").take(SIZE.1 / 2).enumerate() {
        for (x, cell) in line.split("\x1b[38;2;").skip(1).enumerate() {
            let (front, back) = cell.split_once(";48;2;").unwrap();
            let back = back.strip_suffix("m▀").unwrap();
            for (y, codes) in [(2 * row, front), (2 * row + 1, back)] {
                let mut codes = codes.split(';').map(|code| code.parse().unwrap());
                picture[y * SIZE.0 + x] = std::array::from_fn(|_| codes.next().unwrap());
            }
        }
    }
    picture
}

#[test]
fn kitty_and_blocks_draw_the_picture_that_is_written() {
    let (written, seen) = drawn("kitty", kitty);
    assert_eq!(seen, written);
    let (written, seen) = drawn("blocks", blocks);
    assert_eq!(seen, written);
}

/// Six levels are 51 codes apart; a dither is that far off at most, and not on average.
#[test]
fn sixels_draw_the_picture_that_is_written_in_fewer_colours() {
    let (written, seen) = drawn("sixel", sixel);
    for channel in 0..3 {
        let off = |(a, b): (&[u8; 3], &[u8; 3])| f64::from(a[channel]) - f64::from(b[channel]);
        let (mut sum, mut most) = (0.0, 0.0_f64);
        for pair in written.iter().zip(&seen) {
            sum += off(pair);
            most = most.max(off(pair).abs());
        }
        assert!(most <= 52.0 && (sum / written.len() as f64).abs() < 4.0, "{channel}: {most} {sum}");
    }
}
