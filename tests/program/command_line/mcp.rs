//! `mcp`: what an assistant gets at the other end of two pipes.

use std::io::Write;
use std::process::Stdio;

use serde_json::{Value, json};

use super::{regatta, stdout_of};

/// The answers to some messages, each of which is a line.
fn answers(messages: &[String]) -> Vec<Value> {
    let mut server = regatta();
    server.arg("mcp").stdin(Stdio::piped()).stdout(Stdio::piped());
    let mut server = server.spawn().unwrap();
    let mut input = server.stdin.take().unwrap();
    messages.iter().for_each(|message| writeln!(input, "{message}").unwrap());
    drop(input);
    let output = server.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    let text = String::from_utf8(output.stdout).unwrap();
    text.lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

fn request(id: u32, method: &str, params: &Value) -> String {
    json!({"jsonrpc": "2.0", "id": id, "method": method, "params": params}).to_string()
}

fn call(id: u32, tool: &str, arguments: &Value) -> String {
    request(id, "tools/call", &json!({"name": tool, "arguments": arguments}))
}

#[test]
fn an_assistant_gets_what_the_command_line_says() {
    let lines = "v *= 0.9; x += v * dt";
    let found = answers(&[
        request(1, "initialize", &json!({"protocolVersion": "2025-03-26"})),
        json!({"jsonrpc": "2.0", "method": "notifications/initialized"}).to_string(),
        call(2, "rule", &json!({"rule": lines, "fps": 144})),
        call(3, "list", &json!({"what": "metrics"})),
        call(4, "capture", &json!({"scene": "spring", "frames": 1, "size": "64x36"})),
    ]);
    assert_eq!(found.len(), 4, "a notification has no answer");
    assert_eq!(found[0]["result"]["protocolVersion"], "2025-03-26");
    let content = |at: usize| &found[at]["result"]["content"][0];
    let rule: Value = serde_json::from_str(content(1)["text"].as_str().unwrap()).unwrap();
    assert_eq!((&rule["rule"], &rule["fps"]), (&json!(lines), &json!(144.0)));
    assert_eq!(content(2)["text"], stdout_of("list metrics --format json"));
    assert_eq!(content(3)["mimeType"], "image/png");
    assert!(content(3)["data"].as_str().unwrap().starts_with("iVBORw0KGgo"));
}

#[test]
fn every_tool_describes_its_arguments_and_none_writes_a_file() {
    let found = answers(&[request(1, "tools/list", &json!({}))]);
    let tools = found[0]["result"]["tools"].as_array().unwrap();
    assert_eq!(tools.len(), 16);
    for tool in tools {
        assert_eq!(tool["outputSchema"]["type"] == "object", tool["name"] != "capture", "{tool}");
        let schema = &tool["inputSchema"];
        let properties = schema["properties"].as_object().unwrap();
        for name in schema["required"].as_array().unwrap() {
            assert!(properties.contains_key(name.as_str().unwrap()), "{tool}");
        }
        for (name, property) in properties {
            let written = ["out", "force", "plot", "report", "bless", "frame-rows"];
            assert!(!written.contains(&&**name), "{tool}");
            assert!(property["description"].as_str().is_some_and(|it| !it.is_empty()), "{name}");
        }
    }
}

#[test]
fn a_mistake_of_an_assistant_is_answered_and_the_server_goes_on() {
    let found = answers(&[
        "no JSON".into(),
        "{\"id\": 1}".into(),
        request(2, "resources/list", &json!({})),
        call(3, "sail", &json!({})),
        call(4, "trace", &json!({"scene": "spring", "out": "states.csv"})),
        call(5, "trace", &json!({"scene": "sprong"})),
        call(6, "trace", &json!({"scene": "spring", "seconds": 100_000})),
        request(7, "ping", &json!({})),
        call(8, "list", &json!(["metrics"])),
        " ".repeat((1 << 20) + 5) + "5",
        json!({"id": 9, "result": {}}).to_string(),
        format!("[{}, {}]", request(10, "ping", &json!({})), json!({"method": "initialized"})),
    ]);
    let codes: Vec<_> = found[..4]
        .iter()
        .chain(&found[8..10])
        .map(|it| it["error"]["code"].as_i64().unwrap())
        .collect();
    assert_eq!(codes, [-32700, -32600, -32601, -32602, -32602, -32600]);
    assert_eq!(found[10..], [json!([{"jsonrpc": "2.0", "id": 10, "result": {}}])]);
    for (at, remedy) in [(4, "it takes scene"), (5, "did you mean spring?"), (6, "ask for less")] {
        let result = &found[at]["result"];
        assert_eq!(result["isError"], true);
        assert!(result["content"][0]["text"].as_str().unwrap().contains(remedy), "{result}");
    }
    assert_eq!(found[7], json!({"jsonrpc": "2.0", "id": 7, "result": {}}));
}
