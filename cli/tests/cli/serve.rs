//! The server of the browser page.

use crate::support::Folder;
use std::fs;
use std::io::{BufRead, BufReader, Read, Write};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};

/// A server, ended at the end of the test.
struct Server(Child, String);

impl Server {
    fn start(folder: &str) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_halflight"))
            .args(["serve", folder, "--port", "0"])
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
        let address = line.trim().trim_start_matches("http://").trim_end_matches('/').to_owned();
        Self(child, address)
    }

    fn ask(&self, request: &str) -> String {
        let mut stream = TcpStream::connect(&self.1).unwrap();
        write!(stream, "{request}\r\nHost: localhost\r\n\r\n").unwrap();
        let mut answer = String::new();
        stream.read_to_string(&mut answer).unwrap();
        answer
    }
}

impl Drop for Server {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

#[test]
fn the_page_is_served_on_this_machine_and_nothing_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("page");
    fs::create_dir(&page).unwrap();
    fs::write(page.join("index.html"), "<p>light").unwrap();
    fs::write(page.join("a.wasm"), "wasm").unwrap();
    fs::write(folder.path().join("b.html"), "secret").unwrap();
    let server = Server::start(page.to_str().unwrap());
    assert!(server.1.starts_with("127.0.0.1:"), "{}", server.1);
    let index = server.ask("GET / HTTP/1.1");
    assert!(index.starts_with("HTTP/1.1 200 OK\r\nContent-Type: text/html"), "{index}");
    assert!(index.ends_with("\r\n\r\n<p>light"), "{index}");
    for header in ["X-Content-Type-Options: nosniff", "Cache-Control: no-cache", "Connection: close"] {
        assert!(index.contains(&format!("\r\n{header}\r\n")), "{header}: {index}");
    }
    assert!(server.ask("GET /a.wasm?v=2 HTTP/1.1").contains("application/wasm"));
    assert!(server.ask("HEAD / HTTP/1.1").ends_with("\r\n\r\n"));
    // Too long, and without an end.
    let mut stream = TcpStream::connect(&server.1).unwrap();
    let _ = stream.write_all(&[b'/'; 1 << 17]);
    let _ = stream.read(&mut [0; 64]);
    for hidden in [
        "GET /../b.html HTTP/1.1",
        "GET /%2e%2e/b.html HTTP/1.1",
        "GET /..%2fb.html HTTP/1.1",
        "GET /..\\b.html HTTP/1.1",
        "GET //b.html HTTP/1.1",
        "GET /index.html\0.html HTTP/1.1",
        "GET b.html HTTP/1.1",
        "GET",
    ] {
        let answer = server.ask(hidden);
        assert!(answer.starts_with("HTTP/1.1 404"), "{hidden}: {answer}");
    }
    assert!(server.ask("POST / HTTP/1.1").starts_with("HTTP/1.1 405"));
}

#[test]
fn a_folder_without_a_page_is_refused() {
    let run = Folder::new().run("serve .");
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("there is no page in .") && run.stderr.contains("build-www.sh"),
        "{}",
        run.stderr
    );
}
