//! The graphics state: what the following directives inherit.
use std::rc::Rc;

use glam::DAffine3;

use super::{
    colour_spaces::ColourSpace,
    parameters::{Entity, Parameter},
    records::MaterialRef,
    source::TextSpan,
};
use noisefall_scene::scene::SceneError;

/// The graphics state.
#[derive(Clone)]
pub struct State {
    /// From the object to the world, at both times.
    pub maps: [DAffine3; 2],
    /// The times that transformation directives change.
    pub active: [bool; 2],
    pub reverse: bool,
    pub material: MaterialRef,
    pub area_light: Option<Rc<Entity>>,
    /// Names of the media inside and outside of surfaces.
    pub media: [Rc<str>; 2],
    pub space: ColourSpace,
    defaults: [Rc<[Parameter]>; 5],
}

/// Target of the parameters of `Attribute`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AttributeTarget {
    Shape,
    Light,
    Material,
    Medium,
    Texture,
}

/// Larger stacks of attributes are refused.
const DEEPEST: usize = 1 << 14;
/// Parameters that `Attribute` may give to one kind of directives.
const MOST_DEFAULTS: usize = 256;
/// Their values: each further `Attribute` copies them.
const MOST_VALUES: usize = 4096;

/// An entry of the stack of attributes.
enum Saved {
    All(Box<State>),
    Transform([DAffine3; 2]),
    Object(Box<State>),
}

/// The stack of `AttributeBegin`, `TransformBegin` and `ObjectBegin`.
#[derive(Default)]
pub struct Stack(Vec<(Saved, TextSpan)>);

impl Default for State {
    fn default() -> State {
        let none: Rc<[Parameter]> = Rc::new([]);
        let no_medium: Rc<str> = Rc::from("");
        State {
            maps: [DAffine3::IDENTITY; 2],
            active: [true; 2],
            reverse: false,
            material: MaterialRef::Default,
            area_light: None,
            media: [no_medium.clone(), no_medium],
            space: ColourSpace::default(),
            defaults: [0; 5].map(|_| none.clone()),
        }
    }
}

impl State {
    /// Changes the active transforms.
    pub fn transform(&mut self, change: impl Fn(DAffine3) -> DAffine3) {
        for (map, active) in self.maps.iter_mut().zip(self.active) {
            if active {
                *map = change(*map);
            }
        }
    }

    /// The parameters that `Attribute` has given to a kind of directives.
    pub fn defaults(&self, target: AttributeTarget) -> Rc<[Parameter]> {
        self.defaults[target as usize].clone()
    }

    /// Adds parameters of `Attribute`.
    pub fn add_defaults(
        &mut self,
        target: AttributeTarget,
        parameters: Vec<Parameter>,
        place: &TextSpan,
    ) -> Result<(), SceneError> {
        let known = &mut self.defaults[target as usize];
        let values: usize = known.iter().chain(&parameters).map(|parameter| parameter.values.len()).sum();
        if known.len() + parameters.len() > MOST_DEFAULTS || values > MOST_VALUES {
            return Err(
                place.error(format!("more than {MOST_DEFAULTS} attributes are set"), "give them to the shapes themselves")
            );
        }
        *known = known.iter().cloned().chain(parameters).collect();
        Ok(())
    }
}

impl Stack {
    /// `AttributeBegin`.
    pub fn save(&mut self, state: &State, place: TextSpan) -> Result<(), SceneError> {
        self.push(Saved::All(Box::new(state.clone())), place)
    }

    /// `TransformBegin`.
    pub fn save_transform(&mut self, state: &State, place: TextSpan) -> Result<(), SceneError> {
        self.push(Saved::Transform(state.maps), place)
    }

    /// `ObjectBegin`.
    pub fn save_object(&mut self, state: &State, place: TextSpan) -> Result<(), SceneError> {
        self.push(Saved::Object(Box::new(state.clone())), place)
    }

    fn push(&mut self, saved: Saved, place: TextSpan) -> Result<(), SceneError> {
        if self.0.len() >= DEEPEST {
            return Err(place.error(format!("attributes are nested more than {DEEPEST} deep"), "close some of them first"));
        }
        self.0.push((saved, place));
        Ok(())
    }

    /// `AttributeEnd`, `TransformEnd` or `ObjectEnd`, by the word of the directive.
    pub fn restore(&mut self, state: &mut State, word: &str, place: &TextSpan) -> Result<(), SceneError> {
        match (self.0.pop(), word) {
            (Some((Saved::All(saved), _)), "AttributeEnd") | (Some((Saved::Object(saved), _)), "ObjectEnd") => *state = *saved,
            (Some((Saved::Transform(maps), _)), "TransformEnd") => state.maps = maps,
            (Some((_, begin)), _) => {
                let message = format!("`{word}` does not end what began in line {}", begin.line);
                return Err(place.error(message, "the pairs of Begin and End must be nested"));
            }
            (None, _) => return Err(place.error(format!("`{word}` has no beginning"), "remove it, or add its Begin")),
        }
        Ok(())
    }

    /// An error if something has not ended.
    pub fn check_empty(&self) -> Result<(), SceneError> {
        match self.0.last() {
            Some((_, place)) => Err(place.error("this does not end", "its End is missing")),
            None => Ok(()),
        }
    }
}
