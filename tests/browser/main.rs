//! The page in a real browser: headless Chromium, driven by chromedriver.
//!
//! `.ci/run` builds the page and runs this. By hand:
//!
//! ```sh
//! scripts/build-www.sh target/www && cargo build --release
//! HALFLIGHT_WWW=target/www HALFLIGHT_CLI=target/release/halflight \
//!     cargo test -p halflight-tests --test browser -- --test-threads=1
//! ```

mod controls;
mod driver;
mod files;
mod lights;
mod measure;
mod pace;
mod page;
mod pictures;
