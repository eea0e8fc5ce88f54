//! Log-log plots as SVG.

use crate::failure::Failure;
use plotters::chart::ChartContext;
use plotters::coord::Shift;
use plotters::coord::combinators::{BindKeyPoints, LogCoord, WithKeyPoints};
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use std::ops::Range;

/// A figure of one or more panels with common axes and one legend.
#[derive(Debug)]
pub(crate) struct Figure {
    pub(crate) title: String,
    /// Label of the horizontal axes.
    pub(crate) x: String,
    /// Label of the vertical axis.
    pub(crate) y: String,
    pub(crate) panels: Vec<Panel>,
}

/// One set of axes.
#[derive(Debug)]
pub(crate) struct Panel {
    pub(crate) title: String,
    pub(crate) curves: Vec<Curve>,
}

/// Points joined by a line.
#[derive(Debug)]
pub(crate) struct Curve {
    pub(crate) name: String,
    pub(crate) style: Style,
    /// Both coordinates above 0.
    pub(crate) points: Vec<(f64, f64)>,
}

/// How a curve looks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    /// Thick and black: what the others are compared with.
    Plain,
    /// The same with gaps and open markers.
    Dashed,
    /// A colour for each family, a marker for each of its members.
    Coloured { colour: usize, member: usize },
}

/// Colours that people with any colour vision tell apart.
///
/// Source: Okabe, Ito 2008, *Color Universal Design*; the yellow, too pale for lines, is left out, and
/// grey added.
const COLOURS: [RGBColor; 7] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(120, 120, 120),
];

/// Grey of the guide and its name.
const GUIDE: RGBColor = RGBColor(150, 150, 150);

/// Sizes in pixels.
const PANEL: (u32, u32) = (410, 400);
const LEGEND: u32 = 200;
const LINE: i32 = 21;
const FONT: &str = "sans-serif";

/// Of dashed curves (pixels).
const DASH: u32 = 5;
const GAP: u32 = 4;

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Axis = WithKeyPoints<LogCoord<f64>>;
type Axes<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Axis, Axis>>;

/// Draws a figure.
///
/// # Errors
/// When it cannot be drawn.
pub(crate) fn svg(figure: &Figure) -> Result<String, Failure> {
    let mut text = String::new();
    draw(figure, &mut text).map_err(|e| Failure::new(format!("cannot draw the figure: {e}")))?;
    Ok(text)
}

/// Whatever goes wrong while drawing.
type Drawn = Result<(), Box<dyn std::error::Error>>;

/// Draws into a text.
fn draw(figure: &Figure, text: &mut String) -> Drawn {
    let width = PANEL.0 * figure.panels.len() as u32 + LEGEND;
    let root = SVGBackend::with_string(text, (width, PANEL.1)).into_drawing_area();
    root.fill(&WHITE)?;
    let titled = root.titled(&figure.title, (FONT, 17))?;
    let (panels, beside) = titled.split_horizontally(width - LEGEND);
    let ranges = ranges(figure);
    for (i, (area, panel)) in
        panels.split_evenly((1, figure.panels.len())).iter().zip(&figure.panels).enumerate()
    {
        draw_panel(area, figure, panel, &ranges, i == 0)?;
    }
    if let Some(panel) = figure.panels.first() {
        draw_legend(&beside, panel)?;
    }
    root.present()?;
    Ok(())
}

/// What both axes must show, with a little room; the same for all panels, so that they compare.
fn ranges(figure: &Figure) -> [Range<f64>; 2] {
    let points = || figure.panels.iter().flat_map(|p| &p.curves).flat_map(|c| &c.points);
    let range = |of: fn(&(f64, f64)) -> f64| {
        let low = points().map(of).fold(f64::INFINITY, f64::min);
        let high = points().map(of).fold(0.0, f64::max);
        if low <= high { low / 1.25..high * 1.25 } else { 0.1..10.0 }
    };
    [range(|p| p.0), range(|p| p.1)]
}

/// Draws axes, the guide and the curves of a panel.
fn draw_panel(
    area: &Area<'_>,
    figure: &Figure,
    panel: &Panel,
    ranges: &[Range<f64>; 2],
    first: bool,
) -> Drawn {
    let [x, y] = ranges.clone();
    let mut axes = ChartBuilder::on(area)
        .caption(&panel.title, (FONT, 14))
        .margin_left(20)
        .margin_right(12)
        .set_label_area_size(LabelAreaPosition::Left, 64)
        .set_label_area_size(LabelAreaPosition::Bottom, 46)
        .build_cartesian_2d(
            x.clone().log_scale().with_key_points(ticks(&x)),
            y.clone().log_scale().with_key_points(ticks(&y)),
        )?;
    axes.configure_mesh()
        .max_light_lines(0)
        .bold_line_style(RGBColor(225, 225, 225))
        .label_style((FONT, 12))
        .axis_desc_style((FONT, 13))
        .x_desc(&figure.x)
        .y_desc(if first { figure.y.as_str() } else { "" })
        .x_label_formatter(&|x| label(*x))
        .y_label_formatter(&|y| label(*y))
        .draw()?;
    draw_guide(&mut axes, panel, ranges)?;
    // The curve that the others are compared with lies on top.
    for curve in panel.curves.iter().rev() {
        draw_curve(&mut axes, curve)?;
    }
    Ok(())
}

/// 1, 2 and 5 of each decade, without the 2 and 5 where there are many.
fn ticks(range: &Range<f64>) -> Vec<f64> {
    let decades = range.start.log10().floor() as i32..=range.end.log10().ceil() as i32;
    let digits = if decades.clone().count() > 5 { &[1.0][..] } else { &[1.0, 2.0, 5.0] };
    let all = decades.flat_map(|e| digits.iter().map(move |d| d * 10_f64.powi(e)));
    all.filter(|t| range.contains(t)).collect()
}

/// A number on an axis, with the decimals that it needs.
fn label(value: f64) -> String {
    let decimals = (-(value.log10() + 1e-9).floor()).max(0.0) as usize;
    format!("{value:.decimals$}")
}

/// A line that falls as independent samples would, through the start of the first curve.
fn draw_guide(axes: &mut Axes<'_, '_>, panel: &Panel, [x, y]: &[Range<f64>; 2]) -> Drawn {
    let Some(&(x0, y0)) = panel.curves.first().and_then(|c| c.points.first()) else { return Ok(()) };
    let at = |x: f64| (x, y0 * (x / x0).powf(-0.5));
    let end = x.end.min(x0 * (y0 / y.start).powi(2));
    axes.draw_series(DashedLineSeries::new([at(x0), at(end)], 4, 4, GUIDE.into()))?;
    let style = (FONT, 12).into_font().color(&GUIDE).pos(Pos::new(HPos::Right, VPos::Bottom));
    axes.draw_series([EmptyElement::at(at(end)) + Text::new("∝ 1/√time", (0, -14), style)])?;
    Ok(())
}

/// Draws a line with its markers.
fn draw_curve(axes: &mut Axes<'_, '_>, curve: &Curve) -> Drawn {
    let (colour, width) = stroke(curve.style);
    let (line, points) = (colour.stroke_width(width), curve.points.iter().copied());
    if curve.style == Style::Dashed {
        axes.draw_series(DashedLineSeries::new(points, DASH, GAP, line))?;
    } else {
        axes.draw_series(LineSeries::new(points, line))?;
    }
    axes.draw_series(curve.points.iter().map(|&at| marker(curve.style, at)))?;
    Ok(())
}

/// Draws the names of the curves, each beside a piece of its line.
fn draw_legend(area: &Area<'_>, panel: &Panel) -> Drawn {
    let text = (FONT, 13).into_font().color(&BLACK).pos(Pos::new(HPos::Left, VPos::Center));
    for (i, curve) in panel.curves.iter().enumerate() {
        let y = 38 + LINE * i as i32;
        let (colour, width) = stroke(curve.style);
        let (line, ends) = (colour.stroke_width(width), [(4, y), (32, y)]);
        if curve.style == Style::Dashed {
            area.draw(&DashedPathElement::new(ends, DASH, GAP, line))?;
        } else {
            area.draw(&PathElement::new(ends, line))?;
        }
        area.draw(&marker(curve.style, (18, y)))?;
        area.draw(&Text::new(curve.name.as_str(), (40, y), text.clone()))?;
    }
    Ok(())
}

/// Colour and width of a line.
fn stroke(style: Style) -> (RGBColor, u32) {
    match style {
        Style::Plain => (BLACK, 3),
        Style::Dashed => (BLACK, 2),
        Style::Coloured { colour, .. } => (COLOURS[colour % COLOURS.len()], 1),
    }
}

/// The marker of a curve at a place.
fn marker<'b, C: Clone + 'static>(style: Style, at: C) -> DynElement<'static, SVGBackend<'b>, C> {
    let (colour, _) = stroke(style);
    match style {
        Style::Plain => Circle::new(at, 3, colour.filled()).into_dyn(),
        Style::Dashed => Circle::new(at, 4, colour.stroke_width(2)).into_dyn(),
        Style::Coloured { member: 0, .. } => Circle::new(at, 3, colour.filled()).into_dyn(),
        Style::Coloured { member: 1, .. } => TriangleMarker::new(at, 5, colour.filled()).into_dyn(),
        Style::Coloured { member: 2, .. } => Cross::new(at, 4, colour.stroke_width(1)).into_dyn(),
        Style::Coloured { .. } => Circle::new(at, 4, colour.stroke_width(1)).into_dyn(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_figure_holds_its_curves_names_and_axes() {
        let curve = |name: &str, style, scale: f64| {
            let points = (0..5).map(|i| (0.01 * 4_f64.powi(i), scale * 0.5_f64.powi(i))).collect();
            Curve { name: name.into(), style, points }
        };
        let curves = || {
            vec![
                curve("auto", Style::Plain, 10.0),
                curve("--lights <area>", Style::Coloured { colour: 0, member: 2 }, 30.0),
                curve("--adaptive on", Style::Dashed, 5.0),
            ]
        };
        let panel = |title: &str| Panel { title: title.into(), curves: curves() };
        let figure = Figure {
            title: "a scene".into(),
            x: "time".into(),
            y: "error".into(),
            panels: vec![panel("left"), panel("right")],
        };
        let svg = svg(&figure).unwrap();
        assert!(svg.starts_with("<svg") && svg.trim_end().ends_with("</svg>"));
        for word in
            ["a scene", "left", "right", "time", "error", "auto", "--lights &lt;area&gt;", "--adaptive on"]
        {
            assert!(svg.contains(word), "{word}");
        }
        // The first of the colours, in both panels and in the legend.
        assert!(svg.matches("#0072B2").count() >= 3, "{svg}");
    }

    #[test]
    fn a_figure_without_points_is_still_one() {
        let panels = vec![Panel { title: "none".into(), curves: Vec::new() }];
        let figure = Figure { title: String::new(), x: "x".into(), y: "y".into(), panels };
        assert!(svg(&figure).unwrap().contains("none"));
    }

    #[test]
    fn axes_have_round_numbers() {
        let labels = |range| ticks(&range).into_iter().map(label).collect::<Vec<_>>();
        assert_eq!(labels(0.004..0.3), ["0.005", "0.01", "0.02", "0.05", "0.1", "0.2"]);
        assert_eq!(labels(0.7..30.0), ["1", "2", "5", "10", "20"]);
        assert_eq!(labels(0.02..3e4), ["0.1", "1", "10", "100", "1000", "10000"]);
    }
}
