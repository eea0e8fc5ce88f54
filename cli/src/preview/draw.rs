//! Pictures in a terminal: by kitty's protocol, as sixels, or as half blocks of colour.

use crate::args::PreviewHow;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use std::fmt::Write as _;
use std::io::{Write as _, stdout};

/// A protocol for pictures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Protocol {
    /// Source: "Terminal graphics protocol", sw.kovidgoyal.net/kitty/graphics-protocol.
    Kitty,
    /// Source: DEC 1989, "VT330/VT340 Programmer Reference Manual", volume 2, chapter 14.
    Sixel,
    /// The upper half of a cell in the colour of its letter, the lower one in that behind it.
    Blocks,
}

/// Terminals that are known by words in their variables.
const KITTY: [&str; 4] = ["kitty", "ghostty", "wezterm", "konsole"];
const SIXEL: [&str; 5] = ["foot", "mlterm", "contour", "yaft", "mintty"];

/// Largest picture in pixels where a terminal has them.
const MOST: (u32, u32) = (480, 300);
/// Pixels of a cell, as most terminals have them; and the lowest cell that a sixel is given room in.
const CELL: (u32, u32) = (9, 18);
const LOWEST_CELL: u32 = 12;

impl Protocol {
    /// The one that was asked for, or that the terminal says it speaks.
    ///
    /// * `variable` – of the environment
    pub(super) fn new(how: PreviewHow, variable: impl Fn(&str) -> Option<String>) -> Self {
        match how {
            PreviewHow::Kitty => Self::Kitty,
            PreviewHow::Sixel => Self::Sixel,
            PreviewHow::Blocks => Self::Blocks,
            PreviewHow::Auto => {
                let read = |name: &str| variable(name).unwrap_or_default().to_lowercase();
                let known = [read("TERM"), read("TERM_PROGRAM")].concat();
                let speaks = |names: &[&str]| names.iter().any(|name| known.contains(name));
                // What lies between does not pass pictures on.
                if !read("TMUX").is_empty() || known.starts_with("screen") {
                    Self::Blocks
                } else if speaks(&KITTY) || !read("KITTY_WINDOW_ID").is_empty() {
                    Self::Kitty
                } else if speaks(&SIXEL) {
                    Self::Sixel
                } else {
                    Self::Blocks
                }
            }
        }
    }
}

/// A place for a picture in the terminal, drawn over again and again.
#[derive(Debug)]
pub(super) struct Screen {
    protocol: Protocol,
    size: (u32, u32),
    /// Lines that it takes.
    rows: u32,
    is_begun: bool,
}

impl Screen {
    /// For a picture of so many columns and rows, in a terminal of so many cells.
    pub(super) fn new(protocol: Protocol, picture: (u32, u32), cells: (u32, u32)) -> Self {
        let columns = cells.0.saturating_sub(1).clamp(1, 100);
        let lines = cells.1.saturating_sub(4).clamp(1, 40);
        let most = match protocol {
            Protocol::Blocks => (columns, 2 * lines),
            _ => (MOST.0.min(columns * CELL.0), MOST.1.min(lines * LOWEST_CELL)),
        };
        let scale = |of: u32| f64::from(most.0) / f64::from(picture.0) * f64::from(of);
        let scale = if scale(picture.1) > f64::from(most.1) {
            f64::from(most.1) / f64::from(picture.1)
        } else {
            f64::from(most.0) / f64::from(picture.0)
        };
        let scaled = |of: u32| ((scale.min(1.0) * f64::from(of)).round() as u32).max(1);
        let size = (scaled(picture.0), scaled(picture.1));
        let rows = match protocol {
            Protocol::Blocks => size.1.div_ceil(2),
            Protocol::Kitty => size.1.div_ceil(CELL.1),
            Protocol::Sixel => size.1.div_ceil(LOWEST_CELL),
        };
        Self { protocol, size, rows, is_begun: false }
    }

    /// Columns and rows of what is drawn.
    pub(super) const fn pixels(&self) -> (u32, u32) {
        self.size
    }

    /// Draws codes, row by row; leaves the cursor in the line below. A terminal that has gone is no reason to
    /// stop.
    pub(super) fn draw(&mut self, codes: &[[f32; 3]]) {
        let text = self.text(codes);
        let mut out = stdout().lock();
        let _ = out.write_all(text.as_bytes()).and_then(|()| out.flush());
        self.is_begun = true;
    }

    /// What draws them: over what was drawn before.
    fn text(&self, codes: &[[f32; 3]]) -> String {
        let rows = self.rows;
        // Room first, which may scroll; then back up to its first line.
        let mut text = if self.is_begun { String::new() } else { "\n".repeat(rows as usize) };
        let _ = write!(text, "\x1b[{rows}A\r\x1b7");
        match self.protocol {
            Protocol::Kitty => kitty(&mut text, self.size, codes),
            Protocol::Sixel => sixel(&mut text, self.size, codes),
            Protocol::Blocks => blocks(&mut text, self.size, codes),
        }
        let _ = write!(text, "\x1b8\x1b[{rows}B");
        text
    }
}

/// A code in 8 bits.
fn byte(code: f32) -> u8 {
    (code.clamp(0.0, 1.0) * 255.0).round() as u8
}

/// As one image with one number, which replaces itself.
fn kitty(text: &mut String, (width, height): (u32, u32), codes: &[[f32; 3]]) {
    /// Most letters at once.
    const CHUNK: usize = 4096;
    let bytes: Vec<u8> = codes.iter().flat_map(|c| c.map(byte)).collect();
    let letters = STANDARD.encode(bytes);
    let mut chunks = letters.as_bytes().chunks(CHUNK).peekable();
    let mut head = format!("a=T,f=24,i=1,p=1,q=2,C=1,s={width},v={height},");
    while let Some(chunk) = chunks.next() {
        let more = u8::from(chunks.peek().is_some());
        let _ = write!(text, "\x1b_G{head}m={more};{}\x1b\\", String::from_utf8_lossy(chunk));
        head.clear();
    }
}

/// Levels of each channel in sixels.
const LEVELS: u32 = 6;

/// Thresholds of an ordered dither. Source: Bayer 1973.
const BAYER: [[f32; 4]; 4] =
    [[0.0, 8.0, 2.0, 10.0], [12.0, 4.0, 14.0, 6.0], [3.0, 11.0, 1.0, 9.0], [15.0, 7.0, 13.0, 5.0]];

/// In 216 colours, dithered.
fn sixel(text: &mut String, (width, height): (u32, u32), codes: &[[f32; 3]]) {
    let _ = write!(text, "\x1bPq\"1;1;{width};{height}");
    for colour in 0..LEVELS.pow(3) {
        let level = |of: u32| of % LEVELS * 100 / (LEVELS - 1);
        let (r, g, b) = (level(colour / LEVELS / LEVELS), level(colour / LEVELS), level(colour));
        let _ = write!(text, "#{colour};2;{r};{g};{b}");
    }
    let colour = |x: u32, y: u32| {
        let threshold = (BAYER[y as usize % 4][x as usize % 4] + 0.5) / 16.0;
        let level = |code: f32| (code.clamp(0.0, 1.0) * (LEVELS - 1) as f32 + threshold) as u32;
        codes[(y * width + x) as usize].iter().fold(0, |sum, c| sum * LEVELS + level(*c).min(LEVELS - 1))
    };
    for top in (0..height).step_by(6) {
        let band: Vec<Vec<u32>> =
            (0..width).map(|x| (top..height.min(top + 6)).map(|y| colour(x, y)).collect()).collect();
        let mut used: Vec<u32> = band.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        for colour in used {
            let _ = write!(text, "#{colour}");
            let bits = |column: &Vec<u32>| {
                column.iter().zip(0..).map(|(c, bit)| u8::from(*c == colour) << bit).sum::<u8>()
            };
            let columns: Vec<u8> = band.iter().map(bits).collect();
            runs(text, &columns);
            text.push('$');
        }
        text.push('-');
    }
    text.push_str("\x1b\\");
}

/// Columns of six bits; those that repeat by their number, and none at the end that is empty.
fn runs(text: &mut String, columns: &[u8]) {
    let mut runs = columns.chunk_by(|a, b| a == b).peekable();
    while let Some(run) = runs.next() {
        let letter = char::from(b'?' + run[0]);
        match run.len() {
            _ if run[0] == 0 && runs.peek().is_none() => {}
            count @ 4.. => {
                let _ = write!(text, "!{count}{letter}");
            }
            count => text.extend(std::iter::repeat_n(letter, count)),
        }
    }
}

/// Two pixels in a cell.
fn blocks(text: &mut String, (width, height): (u32, u32), codes: &[[f32; 3]]) {
    for y in (0..height).step_by(2) {
        for x in 0..width {
            let at = |y: u32| codes[(y.min(height - 1) * width + x) as usize].map(byte);
            let ([r, g, b], [s, h, c]) = (at(y), at(y + 1));
            let _ = write!(text, "\x1b[38;2;{r};{g};{b};48;2;{s};{h};{c}m▀");
        }
        text.push_str("\x1b[0m\x1b[1B\r");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A red pixel over a blue one.
    const CODES: [[f32; 3]; 2] = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];

    fn drawn(protocol: Protocol) -> String {
        Screen { protocol, size: (1, 2), rows: 1, is_begun: false }.text(&CODES)
    }

    #[test]
    fn the_terminal_says_what_it_speaks() {
        let of = |pairs: &[(&str, &str)]| {
            Protocol::new(PreviewHow::Auto, |name| {
                pairs.iter().find(|(n, _)| *n == name).map(|(_, value)| (*value).to_owned())
            })
        };
        assert_eq!(of(&[("TERM", "xterm-kitty")]), Protocol::Kitty);
        assert_eq!(of(&[("TERM", "xterm-256color"), ("TERM_PROGRAM", "WezTerm")]), Protocol::Kitty);
        assert_eq!(of(&[("TERM", "xterm-kitty"), ("TMUX", "/tmp/x")]), Protocol::Blocks);
        assert_eq!(of(&[("TERM", "foot")]), Protocol::Sixel);
        assert_eq!(of(&[("TERM", "xterm-256color")]), Protocol::Blocks);
        assert_eq!(of(&[]), Protocol::Blocks);
    }

    #[test]
    fn each_protocol_is_as_its_terminals_read_it() {
        let room = ("\n\x1b[1A\r\x1b7", "\x1b8\x1b[1B");
        let framed = |text: &str| format!("{}{text}{}", room.0, room.1);
        let block = "\x1b[38;2;255;0;0;48;2;0;0;255m▀\x1b[0m\x1b[1B\r";
        assert_eq!(drawn(Protocol::Blocks), framed(block));
        let kitty = "\x1b_Ga=T,f=24,i=1,p=1,q=2,C=1,s=1,v=2,m=0;/wAAAAD/\x1b\\";
        assert_eq!(drawn(Protocol::Kitty), framed(kitty));
        let sixel = drawn(Protocol::Sixel);
        assert!(sixel.contains("\x1bPq\"1;1;1;2#0;2;0;0;0#1;2;0;0;20"), "{sixel:?}");
        assert!(sixel.contains("#215;2;100;100;100#5A$#180@$-\x1b\\"), "{sixel:?}");
    }

    #[test]
    fn what_repeats_in_a_sixel_is_counted() {
        let mut text = String::new();
        runs(&mut text, &[0, 0, 0, 0, 0, 63, 63, 63, 63, 1, 1, 1, 0, 0, 2, 0, 0, 0, 0]);
        assert_eq!(text, "!5?!4~@@@??A");
    }

    #[test]
    fn long_pictures_are_sent_in_pieces() {
        let mut text = String::new();
        kitty(&mut text, (100, 100), &[[0.5; 3]; 10_000]);
        assert_eq!(text.matches("\x1b_G").count(), 10);
        assert_eq!((text.matches("m=1;").count(), text.matches("a=T").count()), (9, 1));
        assert!(text.split("\x1b\\").all(|piece| piece.len() < 4200));
    }

    #[test]
    fn a_picture_keeps_its_shape_and_fits() {
        for protocol in [Protocol::Blocks, Protocol::Kitty, Protocol::Sixel] {
            for (picture, cells) in
                [((960, 640), (80, 24)), ((100, 5000), (200, 60)), ((5000, 3), (10, 5)), ((1, 1), (0, 0))]
            {
                let screen = Screen::new(protocol, picture, cells);
                let (width, height) = screen.pixels();
                assert!(
                    width >= 1 && height >= 1 && screen.rows <= cells.1.saturating_sub(3).max(1),
                    "{screen:?}"
                );
                let shape =
                    f64::from(width) / f64::from(height) * f64::from(picture.1) / f64::from(picture.0);
                assert!((0.8..1.25).contains(&shape) || width.min(height) < 5, "{screen:?}");
            }
        }
    }
}
