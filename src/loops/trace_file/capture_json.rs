//! Converts JSON captures of CapFrameX to a table with PresentMon's columns. Each run becomes a separate process.

use serde_json::Value;

/// Name of the array that every capture has.
const FRAMES: &str = "MsBetweenPresents";

/// Converts a capture to a table. If this fails, the error explains why.
pub(super) fn table(bytes: &[u8]) -> Result<String, String> {
    let capture: Value = serde_json::from_slice(bytes).map_err(|error| error.to_string())?;
    let program = capture.pointer("/Info/ProcessName").and_then(Value::as_str).unwrap_or_default();
    let runs = capture.get("Runs").and_then(Value::as_array).ok_or("there are no Runs in it")?;
    let of_run = |run: &Value| -> Option<Vec<(String, Vec<Value>)>> {
        let data = run.get("CaptureData")?.as_object()?;
        let rows = data.get(FRAMES)?.as_array()?.len();
        let columns = data.iter().filter_map(|(name, cells)| Some((name, cells.as_array()?)));
        let whole = columns.filter(|(_, cells)| cells.len() == rows);
        Some(whole.map(|(name, cells)| (name.clone(), cells.clone())).collect())
    };
    let runs: Option<Vec<_>> = runs.iter().map(of_run).collect();
    let runs = runs.ok_or(format!("a run has no CaptureData with {FRAMES}"))?;
    // A column must occur in every run.
    let in_all = |name: &String| runs.iter().all(|run| run.iter().any(|(known, _)| known == name));
    let first = runs.first().ok_or("there is no run in it")?;
    let names: Vec<&String> = first.iter().map(|(name, _)| name).filter(|it| in_all(it)).collect();
    let mut writer = csv::Writer::from_writer(Vec::new());
    let head = ["Application", "ProcessID"].into_iter();
    let mut write = |row: Vec<String>| writer.write_record(row).map_err(|error| error.to_string());
    write(head.chain(names.iter().map(|name| name.as_str())).map(str::to_owned).collect())?;
    for (number, run) in (1..).zip(&runs) {
        let columns: Vec<&Vec<Value>> = names
            .iter()
            .filter_map(|name| run.iter().find(|(known, _)| known == *name).map(|(_, cells)| cells))
            .collect();
        for row in 0..columns.first().map_or(0, |cells| cells.len()) {
            let cells = columns.iter().map(|cells| cell(&cells[row]));
            write([program.to_owned(), format!("{number}")].into_iter().chain(cells).collect())?;
        }
    }
    let table = writer.into_inner().map_err(|error| error.to_string())?;
    String::from_utf8(table).map_err(|error| error.to_string())
}

/// Formats a cell as PresentMon does.
fn cell(value: &Value) -> String {
    match value {
        Value::Null => "NA".into(),
        Value::Bool(flag) => u8::from(*flag).to_string(),
        Value::String(text) => text.clone(),
        other => other.to_string(),
    }
}
