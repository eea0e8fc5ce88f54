//! Numbers as people read them.

/// `24 812`: digits in groups of three.
pub(crate) fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::with_capacity(digits.len() + digits.len() / 3);
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// `1 light`, `24 812 lights`.
pub(crate) fn counted(n: u64, noun: &str) -> String {
    let plural = if n == 1 { "" } else { "s" };
    format!("{} {noun}{plural}", grouped(n))
}

/// Three significant digits for everyday numbers, an exponent for the others.
pub(crate) fn significant(x: f64) -> String {
    rounded(x, 3)
}

/// So many significant digits for everyday numbers, an exponent for the others.
fn rounded(x: f64, digits: u8) -> String {
    if x == 0.0 || !x.is_finite() {
        return x.to_string().replace("inf", "∞");
    }
    let after_first = usize::from(digits.max(1)) - 1;
    let exponent = x.abs().log10().floor();
    if (-4.0..6.0).contains(&exponent) {
        let decimals = (after_first as f64 - exponent).max(0.0) as usize;
        return format!("{x:.decimals$}");
    }
    format!("{x:.after_first$e}")
}

/// `18.7 M`: with the SI prefix that leaves one to three digits before the point.
pub(crate) fn with_prefix(x: f64) -> String {
    for (scale, prefix) in [(1e9, "G"), (1e6, "M"), (1e3, "k")] {
        if x.abs() >= scale {
            return format!("{} {prefix}", significant(x / scale));
        }
    }
    significant(x)
}

/// `1.2 MiB`.
pub(crate) fn bytes(n: u64) -> String {
    let x = n as f64;
    for (shift, unit) in [(30, "GiB"), (20, "MiB"), (10, "KiB")] {
        let scale = f64::from(1_u32 << shift);
        if x >= scale {
            return format!("{} {unit}", significant(x / scale));
        }
    }
    counted(n, "byte")
}

/// `12 ms`, `2.1 s`, `3 min 20 s`.
pub(crate) fn duration(seconds: f64) -> String {
    if seconds < 0.1 {
        return format!("{:.0} ms", 1e3 * seconds);
    }
    if seconds < 10.0 {
        return format!("{seconds:.1} s");
    }
    let whole = seconds.round() as u64;
    match (whole / 3600, whole / 60 % 60, whole % 60) {
        (0, 0, s) => format!("{s} s"),
        (0, m, s) => format!("{m} min {s:02} s"),
        (h, m, _) => format!("{h} h {m:02} min"),
    }
}

/// `0.98 %` for 0.0098: two digits, as an estimate does not know more.
pub(crate) fn percent(fraction: f64) -> String {
    format!("{} %", rounded(100.0 * fraction, 2))
}

/// `0.98 % ± 0.03`: both with as many decimals.
pub(crate) fn percent_within(fraction: f64, interval: f64) -> String {
    let value = rounded(100.0 * fraction, 2);
    let decimals = value.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    if value.contains(['e', '∞', 'N']) {
        return format!("{value} % ± {}", rounded(100.0 * interval, 2));
    }
    format!("{value} % ± {:.decimals$}", 100.0 * interval)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_are_grouped_by_three() {
        assert_eq!(grouped(7), "7");
        assert_eq!(grouped(812), "812");
        assert_eq!(grouped(24_812), "24 812");
        assert_eq!(grouped(1_000_000), "1 000 000");
    }

    #[test]
    fn nouns_are_counted() {
        assert_eq!(counted(0, "light"), "0 lights");
        assert_eq!(counted(1, "light"), "1 light");
        assert_eq!(counted(2000, "light"), "2 000 lights");
    }

    #[test]
    fn three_digits_are_significant() {
        assert_eq!(significant(0.0), "0");
        assert_eq!(significant(0.98), "0.980");
        assert_eq!(significant(18.72), "18.7");
        assert_eq!(significant(1234.0), "1234");
        assert_eq!(significant(1.5e-7), "1.50e-7");
        assert_eq!(significant(f64::INFINITY), "∞");
    }

    #[test]
    fn two_digits_of_an_estimate_are_shown() {
        assert_eq!(percent(0.009_812), "0.98 %");
        assert_eq!(percent(0.1234), "12 %");
        assert_eq!(percent(2.5), "250 %");
        assert_eq!(percent_within(0.009_812, 0.000_31), "0.98 % ± 0.03");
        assert_eq!(percent_within(0.1234, 0.019), "12 % ± 2");
        assert_eq!(percent_within(0.0, 0.0), "0 % ± 0");
        assert_eq!(percent_within(1e-7, 2e-8), "1.0e-5 % ± 2.0e-6");
    }

    #[test]
    fn units_follow_the_size() {
        assert_eq!(with_prefix(18.7e6), "18.7 M");
        assert_eq!(with_prefix(812.0), "812");
        assert_eq!(bytes(1), "1 byte");
        assert_eq!(bytes(1536), "1.50 KiB");
        assert_eq!(bytes(3 << 30), "3.00 GiB");
    }

    #[test]
    fn durations_use_the_two_largest_units() {
        assert_eq!(duration(0.012), "12 ms");
        assert_eq!(duration(2.06), "2.1 s");
        assert_eq!(duration(59.6), "1 min 00 s");
        assert_eq!(duration(200.0), "3 min 20 s");
        assert_eq!(duration(7300.0), "2 h 01 min");
    }
}
