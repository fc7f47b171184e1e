//! `regatta mcp`: a server for assistants, which speaks the Model Context Protocol on standard input and output.
//!
//! A message is a line of JSON-RPC 2.0. Each tool is a command of this program that answers, run in a process of its
//! own, so that an assistant gets what a person at the command line gets. No tool writes a file.

use std::env::current_exe;
use std::io::{self, BufRead, BufReader, Read};
use std::process::{Command, Stdio};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use clap::{Arg, ArgAction, Args, CommandFactory};
use serde_json::{Map, Value, json};

use super::Cli;
use super::error::Error;
use super::help::flowing;
use super::output::print_json;

const ABOUT: &str = "\
An assistant starts it and asks by lines on standard input. In the settings of most assistants:

  {\"mcpServers\": {\"regatta\": {\"command\": \"regatta\", \"args\": [\"mcp\"]}}}

Its tools are the commands that answer, with the names of their options. capture gives a picture. No
tool writes a file; files that are named are read.

Examples:
  regatta mcp
  echo '{\"jsonrpc\": \"2.0\", \"id\": 1, \"method\": \"tools/list\"}' | regatta mcp";

/// Answer an assistant by the Model Context Protocol
#[derive(Debug, Args)]
#[command(after_long_help = flowing(ABOUT))]
pub(super) struct McpArgs {}

/// A command that is a tool, and the arguments with which it answers a program.
type Tool = (&'static str, &'static [&'static str]);

const TOOLS: &[Tool] = &[
    ("advise", JSON),
    ("capture", &["--format=sheet", "--out=-"]),
    ("chapter", JSON),
    ("cloud", JSON),
    ("diff", JSON),
    ("fixture", &["--as=json"]),
    ("identify", JSON),
    ("link", JSON),
    ("list", JSON),
    ("loop", JSON),
    ("port", JSON),
    ("rule", JSON),
    ("show", JSON),
    ("sweep", JSON),
    ("trace", JSON),
    ("verify", JSON),
];
const JSON: &[&str] = &["--format=json"];
/// Options that write files, need one that does, or are about this machine.
const KEPT_BACK: [&str; 9] =
    ["bless", "diff", "force", "frame-rows", "out", "plot", "report", "round-off", "threads"];

/// Versions of the protocol, of which the first is offered to a client of another.
const VERSIONS: [&str; 4] = ["2025-11-25", "2025-06-18", "2025-03-26", "2024-11-05"];
/// The schemas of what the commands print, and the member that holds a list, for a structured answer is an object.
const SCHEMAS: &str = include_str!("../../assets/schema.json");
const ROWS: &str = "rows";
/// Most bytes of a message, and of an answer without its picture.
const MAX_BYTES: u64 = 1 << 20;
const MAX_PICTURE_BYTES: u64 = 1 << 24;

/// Codes of errors, by JSON-RPC.
const NO_JSON: i32 = -32700;
const NO_REQUEST: i32 = -32600;
const NO_METHOD: i32 = -32601;
const NO_ARGUMENTS: i32 = -32602;

type Fault = (i32, String);

pub(super) fn run(_: &McpArgs) -> Result<(), Error> {
    let mut input = BufReader::new(io::stdin());
    loop {
        let mut line = Vec::new();
        let read = input.by_ref().take(MAX_BYTES).read_until(b'\n', &mut line);
        match read.map_err(|why| Error::failed(format!("standard input cannot be read: {why}")))? {
            0 => return Ok(()),
            _ if line.iter().all(u8::is_ascii_whitespace) => continue,
            _ => (),
        }
        let found = if line.len() as u64 == MAX_BYTES && !line.ends_with(b"\n") {
            _ = input.skip_until(b'\n');
            let why = format!("a message has more than {MAX_BYTES} bytes");
            Some(failed(&Value::Null, (NO_REQUEST, why)))
        } else {
            match serde_json::from_slice(&line) {
                Ok(message) => answer(&message),
                Err(why) => Some(failed(&Value::Null, (NO_JSON, why.to_string()))),
            }
        };
        if let Some(answer) = found {
            print_json(format!("{answer}\n"))?;
        }
    }
}

/// Returns the answer to a message, or to each of several in a list; `None` to a notification and to an answer.
fn answer(message: &Value) -> Option<Value> {
    if let Some(all) = message.as_array().filter(|all| !all.is_empty()) {
        let answers: Vec<Value> = all.iter().filter_map(answer).collect();
        return (!answers.is_empty()).then(|| answers.into());
    }
    if message.get("result").or(message.get("error")).is_some() {
        return None;
    }
    let id = message.get("id");
    let Some(method) = message.get("method").and_then(Value::as_str) else {
        let why = "a message needs a method".to_owned();
        return Some(failed(id.unwrap_or(&Value::Null), (NO_REQUEST, why)));
    };
    let id = id?;
    let found = match method {
        "initialize" => Ok(greeting(&message["params"])),
        "ping" => Ok(json!({})),
        "tools/list" => Ok(tools()),
        "tools/call" => call(&message["params"]),
        _ => Err((NO_METHOD, format!("no method is called {method}"))),
    };
    Some(match found {
        Ok(result) => json!({"jsonrpc": "2.0", "id": id, "result": result}),
        Err(fault) => failed(id, fault),
    })
}

fn failed(id: &Value, (code, message): Fault) -> Value {
    json!({"jsonrpc": "2.0", "id": id, "error": {"code": code, "message": message}})
}

fn greeting(asked: &Value) -> Value {
    let asked = asked["protocolVersion"].as_str();
    let version = VERSIONS.into_iter().find(|version| Some(*version) == asked);
    json!({
        "protocolVersion": version.unwrap_or(VERSIONS[0]),
        "capabilities": {"tools": {}},
        "serverInfo": {"name": "regatta", "version": env!("CARGO_PKG_VERSION")},
        "instructions": include_str!("../../assets/SKILL.md"),
    })
}

/// Returns the description of the whole command line.
fn command_line() -> clap::Command {
    let mut cli = Cli::command();
    cli.build();
    cli
}

/// Describes every tool.
fn tools() -> Value {
    let cli = command_line();
    let schemas: Value = serde_json::from_str(SCHEMAS).unwrap_or_default();
    let all = TOOLS.iter().filter_map(|(name, fixed)| {
        cli.find_subcommand(name).map(|command| described(command, fixed, &schemas))
    });
    json!({"tools": all.collect::<Vec<_>>()})
}

/// Returns the arguments of a command that a tool takes, with the name of each. The `fixed` ones are given already.
fn arguments<'c>(
    command: &'c clap::Command,
    fixed: &'static [&'static str],
) -> impl Iterator<Item = (&'c str, &'c Arg)> {
    let named = |arg| (Arg::get_long(arg).unwrap_or_else(|| arg.get_id().as_str()), arg);
    let is_fixed = |name: &str| {
        let mut names = fixed.iter().filter_map(|it| it.strip_prefix("--")?.split('=').next());
        names.any(|it| it == name)
    };
    let all = command.get_arguments().filter(|arg| !arg.is_hide_set()).map(named);
    all.filter(move |(name, _)| *name != "help" && !KEPT_BACK.contains(name) && !is_fixed(name))
}

fn takes_many(arg: &Arg) -> bool {
    matches!(arg.get_action(), ArgAction::Append)
        || arg.get_num_args().is_some_and(|count| count.max_values() > 1)
}

/// Describes a tool with the schema of its arguments, and that of its answer from all `schemas`.
fn described(command: &clap::Command, fixed: &'static [&'static str], schemas: &Value) -> Value {
    let mut properties = Map::new();
    let mut required = Vec::new();
    for (name, arg) in arguments(command, fixed) {
        let help = arg.get_long_help().or(arg.get_help()).map(ToString::to_string);
        let one = json!({"type": ["string", "number"]});
        let mut schema = match arg.get_action() {
            ArgAction::SetTrue => json!({"type": "boolean"}),
            _ if takes_many(arg) => json!({"type": "array", "items": one}),
            _ => one,
        };
        schema["description"] = help.unwrap_or_default().into();
        properties.insert(name.to_owned(), schema);
        if arg.is_required_set() {
            required.push(name.to_owned());
        }
    }
    let about = command.get_about().map(ToString::to_string).unwrap_or_default();
    let more = command.get_after_long_help().map(ToString::to_string).unwrap_or_default();
    let mut tool = json!({
        "name": command.get_name(),
        "description": format!("{about}\n\n{more}"),
        "inputSchema": {
            "type": "object",
            "properties": properties,
            "required": required,
            "additionalProperties": false,
        },
        "annotations": {"readOnlyHint": true, "openWorldHint": false},
    });
    if let Some(schema) = output_schema(schemas, command.get_name()) {
        tool["outputSchema"] = schema;
    }
    tool
}

/// Returns the schema of the structured answer of a tool from `all`, if it has one.
fn output_schema(all: &Value, tool: &str) -> Option<Value> {
    let of_tool = all["$defs"].as_object()?.iter().filter(|(name, _)| {
        // Such as `list methods` and `trace --impacts`.
        name.split(' ').next() == Some(tool)
    });
    let schemas: Vec<&Value> = of_tool.map(|(_, schema)| schema).collect();
    match schemas[..] {
        [] => None,
        [object] if object["type"] == "object" => Some(object.clone()),
        _ => Some(json!({
            "type": "object",
            "properties": {ROWS: {"anyOf": schemas}},
            "required": [ROWS],
        })),
    }
}

/// Runs a tool, and returns what it says. A run that fails is an answer too.
fn call(asked: &Value) -> Result<Value, Fault> {
    let name = asked["name"].as_str().unwrap_or_default();
    let unknown = || (NO_ARGUMENTS, format!("no tool is called {name:?}; tools/list has them"));
    let (name, fixed) = TOOLS.iter().find(|(tool, _)| *tool == name).ok_or_else(unknown)?;
    let cli = command_line();
    let command = cli.find_subcommand(name).ok_or_else(unknown)?;
    let nothing = Map::new();
    let given = match &asked["arguments"] {
        Value::Null => &nothing,
        Value::Object(given) => given,
        other => return Err((NO_ARGUMENTS, format!("`arguments` is an object, not {other}"))),
    };
    let (mut options, mut operands) = (Vec::new(), Vec::new());
    for (key, value) in given {
        let Some((key, arg)) = arguments(command, fixed).find(|(name, _)| name == key) else {
            let known: Vec<_> = arguments(command, fixed).map(|(name, _)| name).collect();
            let why = format!("{name} has no argument {key:?}; it takes {}", known.join(", "));
            return Ok(refused(&why));
        };
        match value {
            Value::Null | Value::Bool(false) => (),
            Value::Bool(true) => options.push(format!("--{key}")),
            Value::Array(all) => all.iter().for_each(|one| match arg.is_positional() {
                true => operands.push(written(one)),
                false => options.push(format!("--{key}={}", written(one))),
            }),
            one if arg.is_positional() => operands.push(written(one)),
            one => options.push(format!("--{key}={}", written(one))),
        }
    }
    options.extend(fixed.iter().map(|&argument| argument.to_owned()));
    if !operands.is_empty() {
        options.push("--".to_owned());
    }
    let is_picture = *name == "capture";
    let said = output_of(name, options.into_iter().chain(operands), is_picture);
    Ok(said.unwrap_or_else(|why| refused(&why)))
}

/// Returns the result of a tool that did not answer.
fn refused(why: &str) -> Value {
    json!({"content": [text(why)], "isError": true})
}

/// Returns a value as it is written on a command line.
fn written(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

fn text(text: &str) -> Value {
    json!({"type": "text", "text": text})
}

/// Runs a command and returns its output as the result of a tool, or why it cannot be had.
fn output_of(
    name: &str,
    arguments: impl Iterator<Item = String>,
    is_picture: bool,
) -> Result<Value, String> {
    let cannot = |why: io::Error| format!("the command cannot be run: {why}");
    let program = current_exe().map_err(cannot)?;
    let mut command = Command::new(program);
    command.arg(name).args(arguments).stdin(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.stdout(Stdio::piped()).spawn().map_err(cannot)?;
    let (out, err) = (child.stdout.take(), child.stderr.take());
    let most = if is_picture { MAX_PICTURE_BYTES } else { MAX_BYTES };
    // Both ends are read at once, for a pipe that is full halts the command.
    let (said, notes) = std::thread::scope(|scope| {
        let notes = scope.spawn(|| start_of(err, most));
        (start_of(out, most), notes.join())
    });
    let said = said.map_err(cannot)?;
    let notes = notes.ok().and_then(Result::ok).unwrap_or_default();
    let notes = String::from_utf8_lossy(&notes).into_owned();
    if said.len() as u64 > most {
        drop(child.kill());
        drop(child.wait());
        return Err(format!("the answer has more than {most} bytes; ask for less"));
    }
    let is_fine = child.wait().map_err(cannot)?.success();
    let answer = match is_picture && is_fine {
        true => json!({"type": "image", "data": STANDARD.encode(&said), "mimeType": "image/png"}),
        false => text(&String::from_utf8_lossy(&said)),
    };
    let notes = Some(text(&notes)).filter(|notes| notes["text"] != "");
    let content: Vec<Value> =
        [Some(answer).filter(|it| it["text"] != ""), notes].into_iter().flatten().collect();
    let structured = match serde_json::from_slice(&said) {
        Ok(Value::Array(rows)) => json!({ROWS: rows}),
        Ok(object @ Value::Object(_)) => object,
        _ => return Ok(json!({"content": content, "isError": !is_fine})),
    };
    // A run that differs fails at the command line, and is an answer here.
    Ok(json!({"content": content, "structuredContent": structured, "isError": false}))
}

/// Reads a pipe to its end, or to one byte more than `most`.
fn start_of(pipe: Option<impl Read>, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    if let Some(pipe) = pipe {
        pipe.take(most + 1).read_to_end(&mut bytes)?;
    }
    Ok(bytes)
}
