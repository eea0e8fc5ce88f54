//! Enough of WebDriver for these tests: JSON over HTTP to a chromedriver on this machine.

use serde_json::{Value, json};
use std::error::Error;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

pub(crate) type Res<T> = Result<T, Box<dyn Error>>;

/// How long the page may take for one thing: debug builds and busy machines included.
const PATIENCE: Duration = Duration::from_secs(120);

/// Flags for a browser without a screen, for root too, that asks nothing of the network.
const FLAGS: [&str; 10] = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-dev-shm-usage",
    "--hide-scrollbars",
];

/// A chromedriver with a browser; both end when this is dropped, and the profile goes.
pub(crate) struct Browser {
    driver: Child,
    port: u16,
    session: String,
    pub(crate) folder: tempfile::TempDir,
}

impl Browser {
    /// `CHROMEDRIVER` names another one than that on the path.
    pub(crate) fn start() -> Res<Self> {
        let program = std::env::var("CHROMEDRIVER").unwrap_or_else(|_| "chromedriver".to_owned());
        let mut driver = Command::new(&program)
            .arg("--port=0")
            .stdin(Stdio::null())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|e| format!("{program}: {e}"))?;
        let mut lines = BufReader::new(driver.stdout.take().ok_or("no output")?).lines();
        let port = loop {
            let line = lines.next().ok_or("chromedriver ended")??;
            if let Some((_, port)) = line.split_once("successfully on port ") {
                break port.trim_end_matches('.').parse()?;
            }
        };
        std::thread::spawn(move || lines.for_each(drop));
        let folder = tempfile::tempdir()?;
        let mut browser = Self { driver, port, session: String::new(), folder };
        browser.open_session()?;
        Ok(browser)
    }

    fn open_session(&mut self) -> Res<()> {
        let mut args: Vec<String> = FLAGS.iter().map(ToString::to_string).collect();
        args.push(format!("--user-data-dir={}", self.folder.path().join("profile").display()));
        let capabilities = json!({ "browserName": "chrome", "goog:chromeOptions": { "args": args },
            "goog:loggingPrefs": { "browser": "ALL" } });
        let body = json!({ "capabilities": { "alwaysMatch": capabilities } });
        let opened = self.call("POST", "/session", &body)?;
        self.session = opened["sessionId"].as_str().ok_or("no session")?.to_owned();
        let downloads = self.folder.path().join("downloads");
        std::fs::create_dir(&downloads)?;
        self.cdp("Browser.setDownloadBehavior", &json!({ "behavior": "allow", "downloadPath": downloads }))?;
        Ok(())
    }

    fn call(&self, method: &str, path: &str, body: &Value) -> Res<Value> {
        let mut stream = TcpStream::connect(("127.0.0.1", self.port))?;
        stream.set_read_timeout(Some(PATIENCE))?;
        // A DELETE with a body is refused.
        let body = if method == "POST" { body.to_string() } else { String::new() };
        write!(
            stream,
            "{method} {path} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nContent-Type: application/json\r\n\
             Content-Length: {}\r\nConnection: close\r\n\r\n{body}",
            self.port,
            body.len()
        )?;
        let mut reader = BufReader::new(stream);
        let mut length = 0;
        loop {
            let mut line = String::new();
            reader.read_line(&mut line)?;
            if let Some((name, value)) = line.split_once(':')
                && name.eq_ignore_ascii_case("content-length")
            {
                length = value.trim().parse()?;
            }
            if line.trim().is_empty() {
                break;
            }
        }
        let mut text = vec![0; length];
        reader.read_exact(&mut text)?;
        let mut answer: Value = serde_json::from_slice(&text)?;
        match answer["value"]["error"].as_str() {
            Some(error) => Err(format!("{path}: {error}: {}", answer["value"]["message"]).into()),
            None => Ok(answer["value"].take()),
        }
    }

    fn in_session(&self, method: &str, path: &str, body: &Value) -> Res<Value> {
        self.call(method, &format!("/session/{}{path}", self.session), body)
    }

    /// A command of the browser's own protocol.
    pub(crate) fn cdp(&self, command: &str, parameters: &Value) -> Res<Value> {
        self.in_session("POST", "/goog/cdp/execute", &json!({ "cmd": command, "params": parameters }))
    }

    /// The size of the window (CSS pixels).
    pub(crate) fn resize(&self, width: u32, height: u32) -> Res<()> {
        let size = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": false });
        self.cdp("Emulation.setDeviceMetricsOverride", &size).map(drop)
    }

    pub(crate) fn goto(&self, url: &str) -> Res<()> {
        self.in_session("POST", "/url", &json!({ "url": url })).map(drop)
    }

    /// What a script returns; a promise is waited for.
    pub(crate) fn run(&self, script: &str) -> Res<Value> {
        self.in_session("POST", "/execute/sync", &json!({ "script": script, "args": [] }))
    }

    /// Waits until an expression is true.
    pub(crate) fn wait(&self, expression: &str) -> Res<()> {
        let end = Instant::now() + PATIENCE;
        while self.run(&format!("return Boolean({expression})"))? != true {
            if Instant::now() > end {
                return Err(format!("not within {PATIENCE:?}: {expression}; {:?}", self.console()?).into());
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        Ok(())
    }

    /// Keys for what has the focus; special ones by their code points of WebDriver.
    pub(crate) fn keys(&self, keys: &str) -> Res<()> {
        let press = |key: char| ["keyDown", "keyUp"].map(|kind| json!({ "type": kind, "value": key }));
        let actions: Vec<_> = keys.chars().flat_map(press).collect();
        self.act(&json!({ "type": "key", "id": "keys", "actions": actions }))
    }

    /// Drags from one place of the window to another, in steps.
    pub(crate) fn drag(&self, from: [i64; 2], to: [i64; 2]) -> Res<()> {
        let at = |[x, y]: [i64; 2]| json!({ "type": "pointerMove", "x": x, "y": y, "duration": 40 });
        let between = |k: i64| [0, 1].map(|i: usize| from[i] + (to[i] - from[i]) * k / 8);
        let mut actions = vec![at(from), json!({ "type": "pointerDown", "button": 0 })];
        actions.extend((1..=8).map(|k| at(between(k))));
        actions.push(json!({ "type": "pointerUp", "button": 0 }));
        let mouse = json!({ "pointerType": "mouse" });
        self.act(&json!({ "type": "pointer", "id": "mouse", "parameters": mouse, "actions": actions }))
    }

    fn act(&self, source: &Value) -> Res<()> {
        self.in_session("POST", "/actions", &json!({ "actions": [source] })).map(drop)
    }

    /// Drops a file in the middle of the window.
    pub(crate) fn drop_file(&self, file: &Path) -> Res<()> {
        let data = json!({ "items": [], "files": [file], "dragOperationsMask": 1 });
        for kind in ["dragEnter", "dragOver", "dragOver", "drop"] {
            let event = json!({ "type": kind, "x": 300, "y": 300, "data": data });
            self.cdp("Input.dispatchDragEvent", &event)?;
        }
        Ok(())
    }

    /// Moves fingers on the window, from places to places.
    pub(crate) fn touch(&self, from: &[[i64; 2]], to: &[[i64; 2]]) -> Res<()> {
        let points = |at: &[[i64; 2]]| -> Vec<_> {
            let finger = |(id, [x, y]): (usize, &[i64; 2])| json!({ "x": x, "y": y, "id": id });
            at.iter().enumerate().map(finger).collect()
        };
        let mut steps = vec![("touchStart", points(from))];
        for k in 1..=5 {
            let between: Vec<_> = from
                .iter()
                .zip(to)
                .map(|(a, b)| [0, 1].map(|i: usize| a[i] + (b[i] - a[i]) * k / 5))
                .collect();
            steps.push(("touchMove", points(&between)));
        }
        steps.push(("touchEnd", Vec::new()));
        for (kind, points) in steps {
            self.cdp("Input.dispatchTouchEvent", &json!({ "type": kind, "touchPoints": points }))?;
        }
        Ok(())
    }

    /// Turns the wheel at a place of the window.
    pub(crate) fn wheel(&self, [x, y]: [i64; 2], by: i64) -> Res<()> {
        let event = json!({ "type": "mouseWheel", "x": x, "y": y, "deltaX": 0, "deltaY": by });
        self.cdp("Input.dispatchMouseEvent", &event).map(drop)
    }

    /// Gives files to the file field.
    pub(crate) fn choose_files(&self, field: &str, files: &[PathBuf]) -> Res<()> {
        let using = json!({ "using": "css selector", "value": field });
        let element = self.in_session("POST", "/element", &using)?;
        let id = element.as_object().and_then(|o| o.values().next()).and_then(Value::as_str);
        let path = format!("/element/{}/value", id.ok_or("no such field")?);
        let names: Vec<_> = files.iter().map(|file| file.display().to_string()).collect();
        self.in_session("POST", &path, &json!({ "text": names.join("\n") })).map(drop)
    }

    /// What the page has written to its console since the last call.
    pub(crate) fn console(&self) -> Res<Vec<String>> {
        let log = self.in_session("POST", "/se/log", &json!({ "type": "browser" }))?;
        let line = |entry: &Value| format!("{} {}", entry["level"], entry["message"]);
        Ok(log.as_array().into_iter().flatten().map(line).collect())
    }

    /// A file that the page has saved, when it is there.
    pub(crate) fn download(&self, name: &str) -> Res<PathBuf> {
        let path = self.folder.path().join("downloads").join(name);
        let end = Instant::now() + PATIENCE;
        while !Path::exists(&path) {
            if Instant::now() > end {
                return Err(format!("{name} was not saved").into());
            }
            std::thread::sleep(Duration::from_millis(50));
        }
        Ok(path)
    }
}

impl Drop for Browser {
    fn drop(&mut self) {
        if !self.session.is_empty() {
            // Ends the browser; killing the driver alone would leave it.
            let _ = self.in_session("DELETE", "", &Value::Null);
        }
        let _ = self.driver.kill();
        let _ = self.driver.wait();
    }
}
