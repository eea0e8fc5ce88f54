//! What the tool `wasm-bindgen --target web` does, from the library: nothing to install.
//!
//! `halflight-bindgen IN.wasm OUT_FOLDER` writes `halflight.js`, `halflight.d.ts` and
//! `halflight_bg.wasm`.

use std::path::Path;
use std::process::ExitCode;

fn main() -> ExitCode {
    let arguments: Vec<_> = std::env::args_os().skip(1).collect();
    let [input, out] = arguments.as_slice() else {
        eprintln!("usage: halflight-bindgen IN.wasm OUT_FOLDER");
        return ExitCode::from(2);
    };
    let written =
        wasm_bindgen_cli_support::Bindgen::new().input_path(Path::new(input)).web(true).and_then(|tool| {
            tool.typescript(true)
                .out_name("halflight")
                .remove_name_section(true)
                .remove_producers_section(true)
                // As the tool does: the JavaScript finds the module beside itself.
                .omit_default_module_path(false)
                .generate(Path::new(out))
        });
    match written {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("halflight-bindgen: {error:#}");
            ExitCode::FAILURE
        }
    }
}
