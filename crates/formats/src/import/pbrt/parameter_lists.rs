//! Lists of parameters in the text: `"type name" [ values ]`.
use super::{
    colour_spaces::ColourSpace,
    parameters::{Parameter, Type, Values},
    source::TextSpan,
    tokens::{Token, Tokens, unquoted},
};
use noisefall_scene::scene::SceneError;

/// Reads the parameters up to the next directive.
pub fn parameters(tokens: &mut Tokens, space: ColourSpace) -> Result<Vec<Parameter>, SceneError> {
    let mut found = Vec::new();
    while tokens.peek()? == Some(Token::Quoted) {
        let Some((_, place)) = tokens.next()? else { break };
        let declaration = unquoted(tokens.text(&place));
        let mut words = declaration.split_whitespace();
        let (Some(of_type), Some(name), None) = (words.next(), words.next(), words.next()) else {
            return Err(place.error(format!("`{declaration}` does not declare a parameter"), "expected \"type name\""));
        };
        let Some(of_type) = type_named(of_type) else {
            return Err(place.error(format!("`{of_type}` is not a type of parameters"), "such as \"float\" or \"point3\""));
        };
        let values = values(tokens, of_type, &place)?;
        found.push(Parameter::new(of_type, name, values, place, space));
    }
    Ok(found)
}

fn type_named(name: &str) -> Option<Type> {
    Some(match name {
        "float" => Type::Float,
        "integer" => Type::Integer,
        "point2" | "vector2" => Type::Pair,
        "point3" | "vector3" | "normal3" | "point" | "vector" | "normal" => Type::Triple,
        "rgb" | "color" => Type::Rgb,
        "spectrum" => Type::Spectrum,
        "blackbody" => Type::Blackbody,
        "string" => Type::String,
        "texture" => Type::Texture,
        "bool" => Type::Bool,
        _ => return None,
    })
}

/// One value, or several in brackets. The type and the first value determine what they are.
fn values(tokens: &mut Tokens, of_type: Type, declaration: &TextSpan) -> Result<Values, SceneError> {
    let mut values = match of_type {
        Type::Bool => Values::Flags(Vec::new()),
        Type::String | Type::Texture => Values::Texts(Vec::new()),
        _ => Values::Numbers(Vec::new()),
    };
    let missing = || declaration.error("the parameter has no value", "it must follow");
    let in_brackets = tokens.peek()? == Some(Token::Open);
    if in_brackets {
        tokens.next()?;
    }
    loop {
        let Some((token, place)) = tokens.next()? else { return Err(missing()) };
        match token {
            Token::Close if in_brackets => return Ok(values),
            Token::Open | Token::Close => return Err(place.error("a bracket stands in the wrong place", "expected a value")),
            _ => add(&mut values, of_type, token, tokens.text(&place), &place)?,
        }
        if !in_brackets {
            return Ok(values);
        }
    }
}

fn add(values: &mut Values, of_type: Type, token: Token, text: &str, place: &TextSpan) -> Result<(), SceneError> {
    // A spectrum is a list of numbers or a name.
    if of_type == Type::Spectrum && token == Token::Quoted && *values == Values::Numbers(Vec::new()) {
        *values = Values::Texts(Vec::new());
    }
    match (values, token) {
        (Values::Numbers(numbers), Token::Word) => numbers.push(number(text, place)?),
        (Values::Texts(texts), Token::Quoted) => texts.push(unquoted(text)),
        (Values::Flags(flags), _) => match text.trim_matches('"') {
            "true" => flags.push(true),
            "false" => flags.push(false),
            _ => return Err(place.error(format!("`{text}` is not true or false"), "expected true or false")),
        },
        (Values::Numbers(_), _) => return Err(place.error(format!("{text} is not a number"), "expected a number")),
        (Values::Texts(_), _) => return Err(place.error(format!("`{text}` is not in quotes"), "expected a quoted string")),
    }
    Ok(())
}

/// A finite number.
pub fn number(text: &str, place: &TextSpan) -> Result<f64, SceneError> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        Ok(_) => Err(place.error(format!("`{text}` is not finite"), "expected a finite number")),
        Err(_) => Err(place.error(format!("`{text}` is not a number"), "expected a number")),
    }
}
