//! memory.x for the machine that the target runs on.

use std::path::Path;
use std::{env, fs};

/// mps2-an386, a Cortex-M4F; the board has 4 MiB of each.
const M4F: &str = "\
MEMORY
{
  FLASH : ORIGIN = 0x00000000, LENGTH = 1M
  RAM : ORIGIN = 0x20000000, LENGTH = 128K
}
";

/// microbit, a Cortex-M0.
const M0: &str = "\
MEMORY
{
  FLASH : ORIGIN = 0x00000000, LENGTH = 256K
  RAM : ORIGIN = 0x20000000, LENGTH = 16K
}
";

/// QEMU's virt board: all is RAM.
const RISCV: &str = r#"
MEMORY { RAM : ORIGIN = 0x80000000, LENGTH = 256K }
REGION_ALIAS("REGION_TEXT", RAM);
REGION_ALIAS("REGION_RODATA", RAM);
REGION_ALIAS("REGION_DATA", RAM);
REGION_ALIAS("REGION_BSS", RAM);
REGION_ALIAS("REGION_HEAP", RAM);
REGION_ALIAS("REGION_STACK", RAM);
"#;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let (folder, target) = (env::var("OUT_DIR")?, env::var("TARGET")?);
    let memory = match target.as_str() {
        "thumbv6m-none-eabi" => M0,
        "riscv32imac-unknown-none-elf" => RISCV,
        _ => M4F,
    };
    fs::write(Path::new(&folder).join("memory.x"), memory)?;
    println!("cargo::rustc-link-search={folder}");
    println!("cargo::rerun-if-changed=build.rs");
    Ok(())
}
