//! `halflight serve`: the browser page on this machine.

use crate::args::ServeArgs;
use crate::failure::{Exit, Failure, io_reason};
use crate::terminal;
use std::fs;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Component, Path, PathBuf};
use std::thread;
use std::time::Duration;

/// Bytes of a request that are read before it is refused.
const MOST_REQUEST: u64 = 1 << 14;
/// How long a client may keep silent.
const PATIENCE: Duration = Duration::from_secs(10);

/// The kinds of file that the page is made of; no other is served.
const KINDS: [(&str, &str); 6] = [
    ("html", "text/html; charset=utf-8"),
    ("css", "text/css; charset=utf-8"),
    ("js", "text/javascript; charset=utf-8"),
    ("wasm", "application/wasm"),
    ("svg", "image/svg+xml"),
    ("ts", "text/plain; charset=utf-8"),
];

/// Serves until it is ended.
pub(crate) fn run(args: &ServeArgs) -> Result<Exit, Failure> {
    let folder = page(&args.folder)?;
    let listener = TcpListener::bind((args.address, args.port)).map_err(|e| {
        Failure::new(format!("cannot listen on {}:{}: {}", args.address, args.port, io_reason(&e)))
            .tip("choose another --port; 0 takes a free one")
    })?;
    let at = listener.local_addr().map_err(|e| Failure::new(io_reason(&e)))?;
    terminal::result(&format!("http://{at}/"))?;
    for stream in listener.incoming().flatten() {
        let folder = folder.clone();
        // A client that hangs up is no concern of the others.
        thread::spawn(move || answer(&stream, &folder).ok());
    }
    Ok(Exit::Good)
}

/// The folder with the page.
fn page(folder: &Path) -> Result<PathBuf, Failure> {
    let found = folder.canonicalize().ok().filter(|f| f.join("index.html").is_file());
    found.ok_or_else(|| {
        Failure::new(format!("there is no page in {}", folder.display()))
            .tip("build it with scripts/build-www.sh, and name the folder: halflight serve target/www")
    })
}

/// Answers one request.
fn answer(stream: &TcpStream, folder: &Path) -> io::Result<()> {
    stream.set_read_timeout(Some(PATIENCE))?;
    stream.set_write_timeout(Some(PATIENCE))?;
    let mut lines = BufReader::new(stream.take(MOST_REQUEST)).lines();
    let request = lines.next().transpose()?.unwrap_or_default();
    for line in lines {
        if line?.is_empty() {
            break;
        }
    }
    let mut words = request.split(' ');
    let (method, target) = (words.next().unwrap_or_default(), words.next().unwrap_or_default());
    let found = find(folder, target).and_then(|(path, kind)| Some((fs::read(path).ok()?, kind)));
    let (status, kind, body) = match (method, found) {
        ("GET" | "HEAD", Some((body, kind))) => ("200 OK", kind, body),
        ("GET" | "HEAD", None) => ("404 Not Found", "text/plain", b"not found\n".to_vec()),
        _ => ("405 Method Not Allowed", "text/plain", b"GET or HEAD\n".to_vec()),
    };
    let mut out = stream;
    write!(
        out,
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {}\r\nCache-Control: no-cache\r\n\
         X-Content-Type-Options: nosniff\r\nConnection: close\r\n\r\n",
        body.len()
    )?;
    if method != "HEAD" {
        out.write_all(&body)?;
    }
    out.flush()
}

/// The file of the page that a request means, with its kind; `None` for anything outside of the folder.
fn find(folder: &Path, target: &str) -> Option<(PathBuf, &'static str)> {
    let path = target.split(['?', '#']).next()?.strip_prefix('/')?;
    let path = Path::new(if path.is_empty() { "index.html" } else { path });
    let plain = path.components().all(|c| matches!(c, Component::Normal(_)));
    let extension = path.extension()?.to_str()?;
    let (_, kind) = KINDS.iter().find(|(known, _)| *known == extension)?;
    // A link inside of the folder may lead out of it.
    let file = folder.join(path).canonicalize().ok().filter(|file| plain && file.starts_with(folder))?;
    Some((file, kind))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_of_the_page_are_found() {
        let outer = tempfile::tempdir().unwrap();
        let outer = outer.path().canonicalize().unwrap();
        let folder = outer.join("www");
        fs::create_dir_all(folder.join("ui")).unwrap();
        for file in ["index.html", "ui/a.js", "notes.txt", "../secret.js"] {
            fs::write(folder.join(file), "x").unwrap();
        }
        let served = |target| find(&folder, target).map(|(path, _)| path);
        assert_eq!(served("/"), Some(folder.join("index.html")));
        assert_eq!(served("/ui/a.js?v=1#there"), Some(folder.join("ui/a.js")));
        for target in [
            "/notes.txt",
            "/../secret.js",
            "/ui/../../secret.js",
            "//secret.js",
            "/%2e%2e/secret.js",
            "/ui",
            "/none.js",
            "index.html",
            "",
        ] {
            assert_eq!(served(target), None, "{target}");
        }
        let absolute = format!("/{}", outer.join("secret.js").display());
        assert_eq!(served(&absolute), None);
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(outer.join("secret.js"), folder.join("link.js")).unwrap();
            assert_eq!(served("/link.js"), None);
        }
    }
}
