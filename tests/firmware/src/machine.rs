//! The machine: where text goes, how a program ends, and how deep the stack has been.

#[cfg(target_arch = "arm")]
mod arm {
    use core::ptr::{addr_of, addr_of_mut};
    use cortex_m_semihosting::debug;

    pub use cortex_m_rt::entry;
    pub use cortex_m_semihosting::{hprint as print, hprintln as println};

    // From cortex-m-rt: the stack grows down from _stack_start to _stack_end.
    unsafe extern "C" {
        static mut _stack_end: u32;
    }

    const PAINT: u32 = 0xa5a5_5a5a;

    /// Bytes of stack that `f` and what it calls have used: what lies below is painted before.
    #[inline(never)]
    pub fn stack_of(f: impl FnOnce()) -> usize {
        let top = cortex_m::register::msp::read() as usize;
        let mut place = addr_of_mut!(_stack_end);
        while (place as usize) < top - 32 {
            // Safety: free stack below this frame.
            unsafe { place.write_volatile(PAINT) };
            place = place.wrapping_add(1);
        }
        f();
        let mut place = addr_of!(_stack_end);
        // Safety: as above.
        while (place as usize) < top && unsafe { place.read_volatile() } == PAINT {
            place = place.wrapping_add(1);
        }
        top - place as usize
    }

    /// Prints that number and ends the program.
    pub fn print_stack_of(f: fn()) -> ! {
        println!("{}", stack_of(f));
        exit(true)
    }

    /// Ends the program; QEMU's exit code says whether all was well.
    pub fn exit(good: bool) -> ! {
        debug::exit(if good { debug::EXIT_SUCCESS } else { debug::EXIT_FAILURE });
        loop {}
    }
}

#[cfg(target_arch = "riscv32")]
mod riscv {
    pub use riscv_rt::entry;
    pub use semihosting::{print, println};

    /// Ends the program; QEMU's exit code says whether all was well.
    pub fn exit(good: bool) -> ! {
        semihosting::process::exit(i32::from(!good))
    }
}

#[cfg(target_arch = "arm")]
pub use arm::*;
#[cfg(target_arch = "riscv32")]
pub use riscv::*;

/// The panic handler of a program in which nothing panics: it cannot be linked, so that a program that
/// could reach it is none.
#[macro_export]
macro_rules! nothing_panics {
    () => {
        #[panic_handler]
        fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
            unsafe extern "C" {
                fn a_panic_can_be_reached() -> !;
            }
            // Safety: never called, as it does not exist.
            unsafe { a_panic_can_be_reached() }
        }
    };
}

/// The panic handler of a program that may.
#[macro_export]
macro_rules! panics_end {
    () => {
        #[panic_handler]
        fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
            $crate::machine::exit(false)
        }
    };
}
