//! The solver's shader code: valid, and computing what the arrangement says. It is run here, expression by expression.

use std::collections::HashMap;

use naga::{
    BinaryOperator, Block, Expression, Function, Handle, MathFunction, Statement, UnaryOperator,
};
use sixfold::imaging::solver::{ShaderLanguage, lookup_code};
use sixfold::mapping::{Arrangement, Axes, ChartPoint, MappingId};
use sixfold::math::Vec3;
use sixfold::math::inputs::Random;

use crate::solving::Dice;
use crate::wgsl;

#[derive(Clone, Copy, Debug, PartialEq)]
enum Value {
    Number(f64),
    Truth(bool),
    Vector([f64; 3]),
}

/// A function of WGSL, run in doubles.
struct Run<'a> {
    function: &'a Function,
    argument: [f64; 3],
    variables: HashMap<Handle<naga::LocalVariable>, Value>,
    /// What has been computed where the text says so, which is once.
    known: HashMap<Handle<Expression>, Value>,
}

impl Run<'_> {
    fn number(&mut self, at: Handle<Expression>) -> f64 {
        match self.value(at) {
            Value::Number(number) => number,
            other => panic!("{other:?} is no number"),
        }
    }

    fn value(&mut self, at: Handle<Expression>) -> Value {
        if let Some(known) = self.known.get(&at) {
            return *known;
        }
        match &self.function.expressions[at] {
            Expression::FunctionArgument(0) => Value::Vector(self.argument),
            Expression::Literal(naga::Literal::F32(number)) => Value::Number(f64::from(*number)),
            Expression::Literal(naga::Literal::Bool(truth)) => Value::Truth(*truth),
            Expression::AccessIndex { base, index } => match self.value(*base) {
                Value::Vector(vector) => Value::Number(vector[*index as usize]),
                other => panic!("no component of {other:?}"),
            },
            Expression::Compose { components, .. } => {
                let numbers: Vec<f64> = components.iter().map(|part| self.number(*part)).collect();
                Value::Vector(numbers.try_into().unwrap())
            }
            Expression::Unary {
                op: UnaryOperator::Negate,
                expr,
            } => Value::Number(-self.number(*expr)),
            Expression::Math {
                fun: MathFunction::Abs,
                arg,
                ..
            } => match self.value(*arg) {
                Value::Vector(vector) => Value::Vector(vector.map(f64::abs)),
                other => panic!("abs of {other:?}"),
            },
            Expression::Binary { op, left, right } => {
                let pair = (self.value(*left), self.value(*right));
                match (op, pair) {
                    (BinaryOperator::LessEqual, (Value::Number(a), Value::Number(b))) => {
                        Value::Truth(a <= b)
                    }
                    (BinaryOperator::GreaterEqual, (Value::Number(a), Value::Number(b))) => {
                        Value::Truth(a >= b)
                    }
                    (BinaryOperator::LogicalAnd, (Value::Truth(a), Value::Truth(b))) => {
                        Value::Truth(a && b)
                    }
                    other => panic!("{other:?}"),
                }
            }
            Expression::LocalVariable(variable) => self.variables[variable],
            Expression::Load { pointer } => match self.function.expressions[*pointer] {
                Expression::LocalVariable(variable) => self.variables[&variable],
                ref other => panic!("{other:?} is no variable"),
            },
            other => panic!("{other:?}"),
        }
    }

    /// What the block returns, where it does.
    fn run(&mut self, block: &Block) -> Option<Value> {
        for statement in block {
            match statement {
                Statement::Emit(range) => {
                    for at in range.clone() {
                        let value = self.value(at);
                        self.known.insert(at, value);
                    }
                }
                Statement::Block(block) => {
                    if let Some(result) = self.run(block) {
                        return Some(result);
                    }
                }
                Statement::If {
                    condition,
                    accept,
                    reject,
                } => {
                    let branch = if self.value(*condition) == Value::Truth(true) {
                        accept
                    } else {
                        reject
                    };
                    if let Some(result) = self.run(branch) {
                        return Some(result);
                    }
                }
                Statement::Store { pointer, value } => {
                    let Expression::LocalVariable(variable) = self.function.expressions[*pointer]
                    else {
                        panic!("stored elsewhere than in a variable");
                    };
                    let value = self.value(*value);
                    self.variables.insert(variable, value);
                }
                Statement::Return { value: Some(value) } => return Some(self.value(*value)),
                other => panic!("{other:?}"),
            }
        }
        None
    }
}

/// What the code returns for a direction.
fn evaluated(module: &naga::Module, dir: Vec3<f64>) -> Vec3<f64> {
    let (_, function) = module.functions.iter().next().unwrap();
    assert_eq!(function.name.as_deref(), Some("lookup_direction"));
    let mut run = Run {
        function,
        argument: dir.to_f64(),
        variables: HashMap::new(),
        known: HashMap::new(),
    };
    match run.run(&function.body) {
        Some(Value::Vector(vector)) => Vec3::from_f64(vector),
        other => panic!("{other:?}"),
    }
}

/// Directions that are looked up at another place than the pictures show them at.
fn wrong(code: &str, arrangement: &Arrangement) -> Result<usize, String> {
    let module = wgsl::parse(code)?;
    let mut random = Random::new(61);
    let mut wrong = 0;
    for _ in 0..60 {
        let dir = Vec3::from_f64(random.direction().map(f64::from));
        let at: ChartPoint<f64> = MappingId::Cube.forward(dir).unwrap();
        // The picture that shows this face, and where it shows the point.
        let held = arrangement.held().iter();
        let (label, held) = held
            .enumerate()
            .find(|(_, held)| held.chart == at.chart)
            .unwrap();
        let [u, v] = held.turn.cell_place([at.u, at.v]);
        let seen: ChartPoint<f64> = MappingId::Cube.forward(evaluated(&module, dir)).unwrap();
        let is_there = (seen.u - u).abs() < 1e-12 && (seen.v - v).abs() < 1e-12;
        wrong += usize::from(!(is_there && seen.chart as usize == label));
    }
    Ok(wrong)
}

fn arrangements() -> impl Iterator<Item = Arrangement> {
    let mut dice = Dice(3);
    let any = (0..100).map(move |_| dice.arrangement());
    let exr = "+x,-x,+y,-y,-z,+z".parse().unwrap();
    Axes::all()
        .map(Arrangement::from_axes)
        .chain([exr])
        .chain(any)
}

#[test]
fn the_code_looks_up_what_the_pictures_show() {
    let (mut whole, mut by_face) = (0, 0);
    for arrangement in arrangements() {
        let code = lookup_code(&arrangement, ShaderLanguage::Wgsl);
        assert_eq!(wrong(&code, &arrangement), Ok(0), "{arrangement}\n{code}");
        let is_whole = arrangement.axes().is_some();
        (whole, by_face) = (
            whole + usize::from(is_whole),
            by_face + usize::from(!is_whole),
        );
        // Controls: a sign, the axes, the order of the conditions.
        for (from, to) in [("-d.x", "d.x"), ("d.y", "d.z"), (">=", "<=")] {
            let broken = code.replace(from, to);
            if broken != code {
                assert!(
                    wrong(&broken, &arrangement).unwrap() > 0,
                    "{arrangement}: {from}\n{code}"
                );
            }
        }
        // The other language is the same text with its own words.
        let glsl = lookup_code(&arrangement, ShaderLanguage::Glsl);
        let head = "vec3 lookup_direction(vec3 d) {";
        assert!(glsl.starts_with(head), "{glsl}");
        let translated = glsl
            .replace(head, "fn lookup_direction(d: vec3f) -> vec3f {")
            .replace("vec3 a =", "let a =")
            .replace("vec3(", "vec3f(");
        assert_eq!(translated, code);
    }
    assert!(whole >= 48 && by_face > 90, "{whole} {by_face}");
    assert!(
        wrong(
            "fn lookup_direction(d: vec3f) -> vec3f { return d.x; }",
            &Arrangement::IDENTITY
        )
        .is_err()
    );
}
