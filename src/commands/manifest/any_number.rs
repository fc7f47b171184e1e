//! Rows of numbers in JSON, which cannot write infinity and NaN as numbers.

use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

#[derive(Deserialize, Serialize)]
#[serde(untagged)]
enum Value {
    Number(f64),
    Word(String),
}

pub(super) fn serialize<S: Serializer>(rows: &[Vec<f64>], to: S) -> Result<S::Ok, S::Error> {
    let value = |&number: &f64| {
        if number.is_finite() { Value::Number(number) } else { Value::Word(number.to_string()) }
    };
    to.collect_seq(rows.iter().map(|row| row.iter().map(value).collect::<Vec<_>>()))
}

pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<Vec<f64>>, D::Error> {
    let number = |value| match value {
        Value::Number(number) => Ok(number),
        Value::Word(word) => match &*word {
            "inf" => Ok(f64::INFINITY),
            "-inf" => Ok(f64::NEG_INFINITY),
            "NaN" => Ok(f64::NAN),
            _ => Err(D::Error::custom(format!("{word:?} is no number"))),
        },
    };
    let rows = Vec::<Vec<Value>>::deserialize(from)?;
    rows.into_iter().map(|row| row.into_iter().map(number).collect()).collect()
}

#[cfg(test)]
mod tests {
    use crate::commands::manifest::LaneMark;

    #[test]
    fn every_value_is_read_back_as_it_was_written() {
        let q = [0.1, -0.0, f64::MAX, 5e-324, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
        let mark = LaneMark { hash: "0".into(), q: vec![q.to_vec(), vec![]], v: vec![] };
        let text = serde_json::to_string(&mark).unwrap();
        assert!(text.contains(r#"5e-324,"inf","-inf","NaN"]"#), "{text}");
        let read: LaneMark = serde_json::from_str(&text).unwrap();
        assert!(read.is_same(&mark));
        assert_eq!(serde_json::to_string(&read).unwrap(), text);
        let mut other = mark.clone();
        other.q[0][6] = 1.0;
        assert!(!other.is_same(&mark));
    }

    #[test]
    fn what_is_no_number_is_refused_with_its_word() {
        let text = r#"{"hash":"0","q":[["many"]],"v":[]}"#;
        let error = serde_json::from_str::<LaneMark>(text).unwrap_err().to_string();
        assert!(error.contains(r#""many" is no number"#), "{error}");
    }
}
