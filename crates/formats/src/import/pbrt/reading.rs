//! Reads what follows a directive: names, numbers, parameters and files.
use std::rc::Rc;

use super::{
    directives::{Interpreter, OpenFile},
    parameter_lists::{number, parameters},
    parameters::{Entity, Parameter},
    source::TextSpan,
    state::AttributeTarget,
    tokens::{Token, Tokens, unquoted},
};
use noisefall_scene::scene::SceneError;

/// Files within files.
const DEEPEST_INCLUDE: usize = 64;

impl Interpreter {
    pub(super) fn include(&mut self, is_import: bool, place: &TextSpan) -> Result<(), SceneError> {
        let named = self.quoted(place)?;
        let label = "paths are relative to the folder of the scene";
        let folder = &self.import.files.folder;
        let path = folder.missing.require(folder.resolve(&named), |message| place.error(message, label))?;
        if self.open.iter().any(|file| file.path == path) {
            return Err(place.error(format!("`{named}` includes itself"), "break the circle"));
        }
        if self.open.len() >= DEEPEST_INCLUDE {
            return Err(place.error(format!("files are nested more than {DEEPEST_INCLUDE} deep"), "include fewer files"));
        }
        let source = self.import.files.text(&path).map_err(|message| place.error(format!("`{named}`: {message}"), label))?;
        let after = is_import.then(|| Box::new(self.state.clone()));
        self.open.push(OpenFile { tokens: Tokens::new(source), path, after });
        Ok(())
    }

    pub(super) fn read_entity(
        &mut self,
        directive: &'static str,
        target: Option<AttributeTarget>,
        place: &TextSpan,
    ) -> Result<Entity, SceneError> {
        let kind = self.quoted(place)?;
        let space = self.state.space;
        let mut own = parameters(self.tokens(), space)?;
        for parameter in Parameter::keep_last(&mut own) {
            let found = format!("`{}` twice for {directive} \"{kind}\"", parameter.name);
            self.import.remarks.add(parameter.place.to_string(), found, "the last one", "pbrt may take another one");
        }
        let inherited = target.map_or_else(|| Rc::new([]) as Rc<[_]>, |target| self.state.defaults(target));
        Ok(Entity::new(directive, kind, place.clone(), own, inherited))
    }

    pub(super) fn tokens(&mut self) -> &mut Tokens {
        // A directive is read while its file is open.
        let last = self.open.len() - 1;
        &mut self.open[last].tokens
    }

    pub(super) fn word(&mut self, directive: &TextSpan) -> Result<(Token, String, TextSpan), SceneError> {
        let tokens = self.tokens();
        match tokens.next()? {
            Some((token, place)) => Ok((token, tokens.text(&place).to_owned(), place)),
            None => Err(directive.error("the directive is not complete", "its values are missing")),
        }
    }

    pub(super) fn quoted(&mut self, directive: &TextSpan) -> Result<String, SceneError> {
        let (token, text, place) = self.word(directive)?;
        match token {
            Token::Quoted => Ok(unquoted(&text)),
            _ => Err(place.error(format!("`{text}` is not in quotes"), "expected a quoted string")),
        }
    }

    /// Numbers, in brackets or not.
    pub(super) fn numbers(&mut self, count: usize, directive: &TextSpan) -> Result<Vec<f64>, SceneError> {
        let in_brackets = self.tokens().peek()? == Some(Token::Open);
        if in_brackets {
            self.word(directive)?;
        }
        let mut numbers = Vec::with_capacity(count);
        for _ in 0..count {
            let (_, text, place) = self.word(directive)?;
            numbers.push(number(&text, &place)?);
        }
        if in_brackets {
            let (token, text, place) = self.word(directive)?;
            if token != Token::Close {
                return Err(place.error(format!("`{text}` is one value too many"), format!("expected {count} numbers")));
            }
        }
        Ok(numbers)
    }
}
