//! `mcp`: the server as a client of another maker drives it.

use std::process::Command;

use serde_json::Value;

use super::stdout_of;

/// A client by the Python package `mcp`, which prints what it gets as JSON.
const CLIENT: &str = r#"
import asyncio, json, sys
from mcp import ClientSession, StdioServerParameters
from mcp.client.stdio import stdio_client

CALLS = [
    ("rule", {"rule": "v *= 0.9; x += v * dt", "fps": 144}),
    ("list", {"what": "metrics"}),
    ("capture", {"scene": "spring", "frames": 1, "size": "64x36"}),
    ("trace", {"scene": "sprong"}),
    ("trace", {"scene": "ball", "seconds": 1, "impacts": True}),
    ("diff", {"a": "tests/data/engines/box2d__spring_1hz_z005_60hz.csv",
        "b": "tests/data/engines/jolt__spring_1hz_z005_60hz.csv"}),
]

async def main():
    async with stdio_client(StdioServerParameters(command=sys.argv[1], args=["mcp"])) as streams:
        async with ClientSession(*streams) as session:
            await session.initialize()
            tools = [tool.name for tool in (await session.list_tools()).tools]
            results = [await session.call_tool(*call) for call in CALLS]
            answers = [result.model_dump(mode="json", by_alias=True) for result in results]
            print(json.dumps({"tools": tools, "answers": answers}))

asyncio.run(main())
"#;

/// The client refuses an answer that its schema does not allow.
pub(crate) fn a_client_of_another_maker_lists_and_calls_the_tools() {
    let mut client = Command::new("python3");
    let done = client.args(["-c", CLIENT, env!("CARGO_BIN_EXE_regatta")]).output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    let found: Value = serde_json::from_slice(&done.stdout).unwrap();
    assert_eq!(found["tools"].as_array().map(Vec::len), Some(16));
    let [rule, list, picture, mistake, impacts, diff] = &found["answers"].as_array().unwrap()[..]
    else {
        panic!("{found}");
    };
    let text = |answer: &Value| answer["content"][0]["text"].as_str().unwrap().to_owned();
    let read = |answer: &Value| serde_json::from_str::<Value>(&text(answer)).unwrap();
    assert_eq!(text(list), stdout_of("list metrics --format json"));
    for (answer, fields) in [(rule, &["fps", "linear"][..]), (diff, &["same", "first"])] {
        let structured = &answer["structuredContent"];
        assert_eq!((structured, answer["isError"].as_bool()), (&read(answer), Some(false)));
        assert!(fields.iter().all(|field| !structured[field].is_null()), "{structured}");
    }
    for rows in [list, impacts] {
        assert_eq!(rows["structuredContent"]["rows"], read(rows));
    }
    assert_eq!(picture["content"][0]["mimeType"], "image/png");
    assert_eq!(mistake["isError"], true);
    assert!(text(mistake).contains("did you mean spring?"), "{mistake}");
}
