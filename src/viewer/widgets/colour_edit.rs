//! A colour button that opens a picker: linear channels, sRGB hex and, for lights, the colour temperature.
use egui::{
    Color32, Id, Popup, PopupCloseBehavior, Response, Sense, Slider, Stroke, StrokeKind, Ui, WidgetInfo,
    accesskit::Role,
    color_picker::{Alpha, color_picker_color32},
    vec2,
};
use noisefall_base::math::{
    colour::luminance,
    temperature::{COLDEST, HOTTEST, black_body, temperature},
};

use super::{
    committed_text,
    explained::Explained,
    hex::{brightness, bytes, from_hex, hex, linear},
    slider::{self, Scale},
};

/// Shows the button. Changes of `rgb`, linear Rec. 709, keep its brightness where it is above 1; `most` bounds every channel.
pub fn show(ui: &mut Ui, label: Id, rgb: &mut [f64; 3], most: f64, is_light: bool) -> Response {
    let [r, g, b] = bytes(*rgb);
    let button =
        button(ui, Color32::from_rgb(r, g, b)).labelled_by(label).on_hover_text("Picks the colour in a wheel or by numbers.");
    Popup::menu(&button).close_behavior(PopupCloseBehavior::CloseOnClickOutside).show(|ui| {
        ui.spacing_mut().slider_width = 180.0;
        let changed = [picker(ui, rgb), hex_field(ui, rgb), is_light && kelvin(ui, rgb)];
        if changed.contains(&true) {
            *rgb = rounded(*rgb).map(|x| x.clamp(0.0, most));
        }
    });
    button
}

fn button(ui: &mut Ui, colour: Color32) -> Response {
    let size = vec2(22.0, ui.spacing().interact_size.y);
    let (rect, response) = ui.allocate_exact_size(size, Sense::click());
    response.widget_info(|| WidgetInfo::new(Role::ColorWell));
    let visuals = ui.style().interact(&response);
    ui.painter().rect_filled(rect, 3.0, colour);
    ui.painter().rect_stroke(rect, 3.0, Stroke::new(1.0, visuals.fg_stroke.color), StrokeKind::Inside);
    response
}

/// The colour without the digits that no eye and no screen tells apart.
fn rounded(rgb: [f64; 3]) -> [f64; 3] {
    /// Significant digits of the largest channel.
    const DIGITS: i32 = 7;
    let most = rgb.into_iter().fold(f64::MIN_POSITIVE, f64::max);
    let decimals = (DIGITS - 1 - most.log10().floor() as i32).clamp(0, 300) as usize;
    rgb.map(|x| format!("{x:.decimals$}").parse().unwrap_or(x))
}

/// The plane of saturation and value with the strip of hues.
fn picker(ui: &mut Ui, rgb: &mut [f64; 3]) -> bool {
    let [r, g, b] = bytes(*rgb);
    let before = Color32::from_rgb(r, g, b);
    let mut colour = before;
    // It reports changes by its own rounding.
    color_picker_color32(ui, &mut colour, Alpha::Opaque);
    if colour != before {
        let brightness = brightness(*rgb);
        *rgb = linear([colour.r(), colour.g(), colour.b()]).map(|x| x * brightness);
    }
    colour != before
}

fn hex_field(ui: &mut Ui, rgb: &mut [f64; 3]) -> bool {
    let field = ui.horizontal(|ui| {
        let label = ui.label("sRGB").on_hover_text("Sets the colour from its hexadecimal sRGB value and keeps the brightness.");
        committed_text::show(ui, label.id, &hex(*rgb), 80.0)
    });
    let field = field.inner;
    if let Err(refusal) = from_hex(&field.typed) {
        ui.colored_label(ui.visuals().error_fg_color, refusal);
    }
    let entered = field.entered.and_then(|text| from_hex(&text).ok());
    if let Some(bytes) = entered {
        let brightness = brightness(*rgb);
        *rgb = linear(bytes).map(|x| x * brightness);
    }
    entered.is_some()
}

/// The temperature of daylight, kelvin.
const DAYLIGHT: f64 = 6504.0;

/// Sets the colour of a black body of the same luminance.
fn kelvin(ui: &mut Ui, rgb: &mut [f64; 3]) -> bool {
    let found = temperature(*rgb);
    let mut kelvin = found.unwrap_or(DAYLIGHT).round();
    let now = kelvin;
    let slider = ui.horizontal(|ui| {
        let label = ui.label("Temperature").on_hover_text("Sets the colour to that of a black body and keeps the luminance.");
        let scale = Scale { range: COLDEST..=HOTTEST, is_logarithmic: true };
        let slider = slider::show(ui, &mut kelvin, &scale, DAYLIGHT, |ui, kelvin| {
            let slider = Slider::new(kelvin, COLDEST..=HOTTEST).logarithmic(true).fixed_decimals(0);
            ui.add(Explained::new(slider, now).suffix(" K")).labelled_by(label.id)
        });
        if found.is_none() {
            ui.weak("none");
        }
        slider
    });
    let changed = slider.inner.changed() || kelvin != now;
    if changed {
        let y = f64::from(luminance(rgb.map(|x| x as f32)));
        *rgb = black_body(kelvin).map(|x| x * if y > 0.0 { y } else { 1.0 });
    }
    changed
}

#[cfg(test)]
mod tests {
    use egui::Key;
    use egui_kittest::{Harness, kittest::Queryable};

    use super::*;

    fn open(rgb: [f64; 3], is_light: bool) -> Harness<'static, [f64; 3]> {
        let draw = move |ui: &mut Ui, rgb: &mut [f64; 3]| {
            let label = ui.label("L_e").id;
            show(ui, label, rgb, 1e15, is_light);
        };
        let mut harness = Harness::builder().with_size(vec2(500.0, 600.0)).build_ui_state(draw, rgb);
        harness.get_by_role(Role::ColorWell).click();
        harness.run_steps(4);
        harness
    }

    #[test]
    fn a_hexadecimal_colour_keeps_the_brightness() {
        let mut harness = open([50.0, 50.0, 50.0], false);
        let field = |harness: &Harness<'static, [f64; 3]>| harness.get_by_role_and_label(Role::TextInput, "sRGB").rect();
        assert!(field(&harness).width() > 10.0);
        harness.get_by_role_and_label(Role::TextInput, "sRGB").focus();
        harness.run_steps(3);
        harness.key_press_modifiers(egui::Modifiers::COMMAND, Key::A);
        harness.event(egui::Event::Text("#ff0000".to_owned()));
        harness.run_steps(3);
        harness.key_press(Key::Enter);
        harness.run_steps(3);
        assert_eq!(*harness.state(), [50.0, 0.0, 0.0]);
        assert!(harness.query_by_label("Temperature").is_none(), "a surface has none");
    }

    #[test]
    fn a_temperature_keeps_the_luminance() {
        let mut harness = open([10.0; 3], true);
        let slider = harness.get_by_role_and_label(Role::Slider, "Temperature");
        slider.set_value_accesskit(3000.0);
        harness.run_steps(3);
        let rgb = *harness.state();
        assert!((f64::from(luminance(rgb.map(|x| x as f32))) - 10.0).abs() < 1e-4);
        assert!(temperature(rgb).is_some_and(|kelvin| (kelvin - 3000.0).abs() < 1.0), "{rgb:?}");
    }

    #[test]
    fn a_picked_colour_is_written_with_few_digits() {
        assert_eq!(rounded([0.214_041_140_482_232_55, 1.0, 1.0 / 3.0]), [0.214_041, 1.0, 0.333_333]);
        assert_eq!((rounded([0.0; 3]), rounded([1_234.567_891, 0.0, 5.0])), ([0.0; 3], [1_234.568, 0.0, 5.0]));
        for byte in 0..=255 {
            let rgb = linear([byte, 255 - byte, 3]);
            assert_eq!(bytes(rounded(rgb)), bytes(rgb), "it is the same colour on the screen");
        }
    }

    #[test]
    fn looking_at_a_colour_changes_nothing() {
        let rgb = [0.123_456, 0.7, 1e-5];
        let mut harness = open(rgb, true);
        harness.get_by_role_and_label(Role::TextInput, "sRGB").focus();
        harness.run_steps(3);
        harness.key_press(Key::Enter);
        harness.run_steps(3);
        assert_eq!(*harness.state(), rgb);
    }
}
