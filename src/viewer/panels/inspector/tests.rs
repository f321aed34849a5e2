//! The inspector, driven as a user would: without a window around it.
use egui::{Event, Key, Modifiers, PointerButton, Pos2, accesskit::Role, vec2};
use egui_kittest::{Harness, kittest::Queryable};
use noisefall_base::declare::{Declare, Family, OneOf, OwnedValue, Parameter, Parameters, Path, Textured, Value};
use noisefall_scene::{
    material::{Conductor, Lambertian, Material},
    scene::description::{EmissionDescription, MaterialDescription, ObjectDescription},
    shape::{ShapeKind, Transform},
    texture::TextureKind,
};

use super::{Drag, Inspector, InspectorRequests, Request, Surroundings};
use crate::viewer::widgets::palette::set_fonts;

struct State<T> {
    part: T,
    asked: Vec<InspectorRequests>,
}

type Panel<T> = Harness<'static, State<T>>;

/// The inspector of a part of a scene at the path `part`.
fn inspect<T: Declare + 'static>(part: T) -> Panel<T> {
    let (names, mut inspector) = (["gold", "white"].map(str::to_owned), Inspector::default());
    let mut has_fonts = false;
    let draw = move |ui: &mut egui::Ui, state: &mut State<T>| {
        // Units have letters that only the fonts of the window have, from the next frame on.
        if !std::mem::replace(&mut has_fonts, true) {
            return set_fonts(ui.ctx());
        }
        let surroundings = Surroundings { textures: &names, materials: &names, count_objects: &|_| 2, size: 1.0 };
        let asked = inspector.show(ui, &mut state.part, &Path::of("part"), &surroundings);
        if asked != InspectorRequests::default() {
            state.asked.push(asked);
        }
    };
    Harness::builder().with_size(vec2(336.0, 900.0)).build_ui_state(draw, State { part, asked: Vec::new() })
}

/// Returns the only request of a click or a field.
fn only<T>(panel: &Panel<T>) -> &Request {
    match &panel.state().asked[..] {
        [InspectorRequests { requests, drag: Drag::None }] if requests.len() == 1 => &requests[0],
        asked => panic!("expected one request: {asked:?}"),
    }
}

fn set(path: &str, value: OwnedValue) -> Request {
    Request::Set { path: Path::of(path), value }
}

fn type_in<T>(panel: &mut Panel<T>, label: &str, place: usize, text: &str) {
    panel.get_all_by_role_and_label(Role::SpinButton, label).nth(place).expect("there is such a field").click();
    panel.run_steps(4);
    panel.key_press_modifiers(Modifiers::COMMAND, Key::A);
    panel.event(Event::Text(text.to_owned()));
    panel.run_steps(3);
    panel.key_press(Key::Enter);
    panel.run_steps(3);
}

fn click<T>(panel: &mut Panel<T>, role: Role, label: &str) {
    panel.get_by_role_and_label(role, label).click();
    panel.run_steps(4);
}

fn lambertian() -> MaterialDescription {
    MaterialDescription { kind: Lambertian { albedo: Textured::grey(0.5) }.into(), ..MaterialDescription::default() }
}

/// The keys of the values that a declaration visits.
struct Keys(Vec<&'static str>);

impl Parameters for Keys {
    fn value(&mut self, parameter: &Parameter, _: Value<'_>) {
        self.0.push(parameter.key);
    }
}

#[test]
fn every_parameter_of_every_kind_has_a_row() {
    fn rows<T: OneOf + 'static>() {
        for mut alternative in T::alternatives() {
            let (mut keys, name) = (Keys(Vec::new()), alternative.name());
            alternative.chosen(&mut keys);
            let panel = inspect(Kind(alternative));
            for key in keys.0 {
                assert!(
                    panel.query_all_by_label_contains(&Parameter::new(key, "").label()).count() > 0,
                    "{name} has no row for {key}"
                );
            }
            assert!(panel.state().asked.is_empty(), "looking at {name} changes nothing");
        }
    }
    rows::<Material>();
    rows::<TextureKind>();
    rows::<ShapeKind>();
    rows::<Transform>();
}

/// A table that holds a choice.
struct Kind<T>(T);

impl<T: OneOf> Declare for Kind<T> {
    fn parameters(&mut self, p: &mut dyn Parameters) {
        p.one_of(&mut self.0);
    }
}

#[test]
fn a_typed_channel_sets_the_colour() {
    let mut panel = inspect(lambertian());
    type_in(&mut panel, "Albedo ρ", 1, "0.25");
    let colour = Textured::Constant([0.5, 0.25, 0.5]);
    assert_eq!(*only(&panel), set("part.lambertian.albedo", OwnedValue::Textured(colour)));
}

#[test]
fn a_value_out_of_range_is_refused_in_the_words_of_the_reader() {
    let mut panel = inspect(lambertian());
    type_in(&mut panel, "Albedo ρ", 0, "1.5");
    assert!(panel.state().asked.is_empty());
    let message = "“albedo” is out of range: 1.5; every channel must lie in [0, 1]: a surface cannot reflect more light than it \
                   receives";
    assert!(panel.query_by_label(message).is_some());
    type_in(&mut panel, "Albedo ρ", 0, "red");
    assert!(panel.query_by_label("“albedo”: expected a number, found “red”").is_some());
}

#[test]
fn another_kind_is_chosen_from_the_menu() {
    let mut panel = inspect(lambertian());
    click(&mut panel, Role::ComboBox, "Type");
    click(&mut panel, Role::Button, "thin dielectric");
    let name = "thin_dielectric";
    assert_eq!(*only(&panel), Request::Choose { path: Path::of("part"), choice: "material", name });
}

#[test]
fn a_texture_takes_the_place_of_a_colour_and_gives_it_back() {
    let mut panel = inspect(lambertian());
    click(&mut panel, Role::Button, "Albedo ρ");
    click(&mut panel, Role::Button, "gold");
    let named = Textured::Texture("gold".to_owned());
    assert_eq!(*only(&panel), set("part.lambertian.albedo", OwnedValue::Textured(named.clone())));

    let mut panel = inspect(MaterialDescription { kind: Lambertian { albedo: named }.into(), ..lambertian() });
    click(&mut panel, Role::ComboBox, "Albedo ρ");
    click(&mut panel, Role::Button, "constant");
    assert_eq!(*only(&panel), set("part.lambertian.albedo", OwnedValue::Textured(Textured::grey(0.5))));
    panel.state_mut().asked.clear();
    click(&mut panel, Role::ComboBox, "Albedo ρ");
    click(&mut panel, Role::Button, "From a file…");
    assert_eq!(*only(&panel), Request::BrowseTexture { path: Path::of("part.lambertian.albedo") });
}

#[test]
fn optional_tables_appear_and_disappear() {
    let mut panel = inspect(lambertian());
    click(&mut panel, Role::CheckBox, "Bump");
    assert_eq!(*only(&panel), Request::Insert { path: Path::of("part.bump") });
    let light = ObjectDescription { emission: Some(EmissionDescription::default()), ..ObjectDescription::default() };
    let mut panel = inspect(light);
    click(&mut panel, Role::CheckBox, "Emission");
    assert_eq!(*only(&panel), Request::Remove { path: Path::of("part.emission") });
}

#[test]
fn a_material_is_assigned_by_name() {
    let mut panel = inspect(ObjectDescription::default());
    click(&mut panel, Role::ComboBox, "Material");
    click(&mut panel, Role::Button, "white");
    assert_eq!(*only(&panel), set("part.material", OwnedValue::Text("white".to_owned())));
    let mut panel = inspect(ObjectDescription { material: Some("white".to_owned()), ..ObjectDescription::default() });
    click(&mut panel, Role::ComboBox, "Material");
    click(&mut panel, Role::Button, "none");
    assert_eq!(*only(&panel), Request::Remove { path: Path::of("part.material") });
}

#[test]
fn a_button_leads_to_the_material_or_texture_that_a_row_names() {
    let mut panel = inspect(ObjectDescription { material: Some("white".to_owned()), ..ObjectDescription::default() });
    panel.get_by_role_and_label(Role::Button, "Edit").hover();
    panel.run_steps(12);
    assert!(panel.query_by_label("Shows the material white, which 2 objects use.").is_some());
    click(&mut panel, Role::Button, "Edit");
    assert_eq!(*only(&panel), Request::Show { family: Family::Material, name: "white".to_owned() });
    let kind = Lambertian { albedo: Textured::Texture("gold".to_owned()) }.into();
    let mut panel = inspect(MaterialDescription { kind, ..MaterialDescription::default() });
    click(&mut panel, Role::Button, "Edit");
    assert_eq!(*only(&panel), Request::Show { family: Family::Texture, name: "gold".to_owned() });
}

#[test]
fn items_are_added_to_lists_and_removed() {
    let transform = vec![Transform::default(), Transform::Scale(glam::DVec3::ONE)];
    let mut panel = inspect(ObjectDescription { transform, ..ObjectDescription::default() });
    click(&mut panel, Role::Button, "Transform");
    assert_eq!(*only(&panel), Request::Insert { path: Path::of("part.transform.2") });
    panel.state_mut().asked.clear();
    panel.get_all_by_role_and_label(Role::Button, "×").nth(1).expect("two items").click();
    panel.run_steps(3);
    assert_eq!(*only(&panel), Request::Remove { path: Path::of("part.transform.1") });
}

#[test]
fn the_name_of_an_object_counts_when_it_is_entered() {
    let mut panel = inspect(ObjectDescription { name: "ball".to_owned(), ..ObjectDescription::default() });
    panel.get_by_role_and_label(Role::TextInput, "Name").focus();
    panel.run_steps(3);
    panel.key_press_modifiers(Modifiers::COMMAND, Key::A);
    panel.event(Event::Text("globe".to_owned()));
    panel.run_steps(3);
    assert!(panel.state().asked.is_empty());
    panel.key_press(Key::Enter);
    panel.run_steps(3);
    assert_eq!(*only(&panel), set("part.name", OwnedValue::Text("globe".to_owned())));
}

#[test]
fn a_drag_goes_on_until_the_button_is_released() {
    let mut panel = inspect(MaterialDescription { kind: Conductor::default().into(), ..lambertian() });
    let slider = panel.get_all_by_role(Role::Slider).next().expect("roughness has a slider").rect();
    let button = |panel: &Panel<_>, pos: Pos2, pressed: bool| {
        let modifiers = Modifiers::NONE;
        panel.event(Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers });
    };
    let from = slider.left_center() + vec2(10.0, 0.0);
    panel.hover_at(from);
    panel.run_steps(2);
    button(&panel, from, true);
    panel.run_steps(2);
    panel.hover_at(slider.center());
    panel.run_steps(2);
    assert!(panel.state().asked.iter().all(|asked| asked.drag == Drag::Going) && !panel.state().asked.is_empty());
    button(&panel, slider.center(), false);
    panel.run_steps(2);
    assert_eq!(panel.state().asked.last().map(|asked| asked.drag), Some(Drag::Ended));
    panel.state_mut().asked.clear();
    panel.run_steps(3);
    assert!(panel.state().asked.is_empty(), "it ends once");
}

#[test]
fn controls_that_do_not_fit_beside_their_label_go_on_below_the_first() {
    let panel = inspect(lambertian());
    let swatch = panel.get_by_role(Role::ColorWell).rect();
    let map = panel.get_by_role_and_label(Role::Button, "Albedo ρ").rect();
    assert!(map.left() >= swatch.left() - 0.5, "{map:?} {swatch:?}");
}
