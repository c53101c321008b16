//! QEMU's plugin interface, versions 1 to 7, as far as it is used here: the declarations
//! of `qemu-plugin.h`, looked up by name when the plugin is installed. Were they
//! linked against, no ordinary program could contain this crate.
//!
//! | version | QEMU | what changed of what is used here |
//! |---|---|---|
//! | 1 | 4.2 to 8.2 | |
//! | 2 | 9.0 | version 1 is refused |
//! | 3 | 9.1 | `qemu_plugin_insn_data` copies into a buffer |
//! | 4, 5, 6 | 9.2 and later, 10 | nothing |
//! | 7 | later | the callbacks of translation and exit take a pointer of the plugin's own, not its number |

use std::ffi::{CStr, OsStr, c_char, c_int, c_uint, c_void};

/// From this version on `qemu_plugin_insn_data` copies.
pub const COPIES: c_int = 3;

/// From this version on callbacks get a pointer of the plugin's own instead of its number.
pub const USER_DATA: c_int = 7;

/// Functions that came with a version, the newest first.
const CAME_WITH: [(c_int, &CStr); 4] = [
    (6, c"qemu_plugin_set_pc"),
    (5, c"qemu_plugin_translate_vaddr"),
    (4, c"qemu_plugin_read_memory_vaddr"),
    (2, c"qemu_plugin_scoreboard_new"),
];

/// The version to ask for: the requested one if it is a number, or the newest of which the program
/// that loads the plugin has a function. QEMU takes the versions between a least one and its own.
pub fn version_to_ask_for(requested: Option<&OsStr>, has: impl Fn(&CStr) -> bool) -> c_int {
    let requested = requested.and_then(|text| text.to_str()?.parse().ok());
    let guessed = || CAME_WITH.iter().find(|(_, name)| has(name));
    requested.unwrap_or_else(|| guessed().map_or(1, |(version, _)| *version))
}

/// Whether the program that loaded the plugin has a function.
pub fn host_has(name: &CStr) -> bool {
    // SAFETY: the name ends in a zero.
    !unsafe { dlsym(EVERYWHERE, name.as_ptr()) }.is_null()
}

/// Number by which QEMU knows a plugin.
pub type PluginId = u64;

/// A block being translated (opaque).
#[repr(C)]
pub struct Tb([u8; 0]);

/// An instruction being translated (opaque).
#[repr(C)]
pub struct TbInsn([u8; 0]);

/// The beginning of `qemu_info_t`; on a system emulation the last fields are valid.
#[repr(C)]
pub struct Info {
    /// "arm" for a Cortex-M.
    pub target_name: *const c_char,
    /// Lowest version of the interface that QEMU takes.
    pub version_min: c_int,
    /// Its own version of the interface.
    pub version_cur: c_int,
    /// Whether it emulates a machine rather than a process.
    pub system_emulation: bool,
    /// Processors at the start.
    pub smp_vcpus: c_int,
    /// Processors at most.
    pub max_vcpus: c_int,
}

/// Called with the processor's index and what was registered.
pub type ExecCallback = extern "C" fn(c_uint, *mut c_void);

/// What an access to memory is like: `qemu_plugin_meminfo_t`.
pub type MemInfo = u32;

/// Called with the processor's index, the access, its address and what was registered.
pub type MemCallback = extern "C" fn(c_uint, MemInfo, u64, *mut c_void);

/// `QEMU_PLUGIN_MEM_RW`: call back at reads and writes. QEMU 7.2 takes one for the other.
pub const ACCESSES: c_int = 3;

/// `QEMU_PLUGIN_CB_NO_REGS`: the callback does not look at registers.
pub const NO_REGISTERS: c_int = 0;

unsafe extern "C" {
    fn dlsym(handle: *mut c_void, name: *const c_char) -> *mut c_void;
}

/// `RTLD_DEFAULT`: search the program and the libraries it has loaded.
#[cfg(target_vendor = "apple")]
const EVERYWHERE: *mut c_void = -2_isize as *mut c_void;
#[cfg(not(target_vendor = "apple"))]
const EVERYWHERE: *mut c_void = std::ptr::null_mut();

macro_rules! functions {
    ($($field:ident = $name:literal: fn($($argument:ty),*) $(-> $result:ty)?;)+) => {
        /// QEMU's functions, under their names without `qemu_plugin_`.
        #[derive(Clone, Copy)]
        pub struct Qemu {
            $(pub $field: unsafe extern "C" fn($($argument),*) $(-> $result)?,)+
        }

        impl Qemu {
            /// Finds them all, or names the one that is missing.
            pub fn find() -> Result<Self, &'static CStr> {
                Ok(Self {
                    $($field: {
                        // SAFETY: the name ends in a zero.
                        let address = unsafe { dlsym(EVERYWHERE, $name.as_ptr()) };
                        if address.is_null() {
                            return Err($name);
                        }
                        // SAFETY: QEMU defines the function of this name with these types,
                        // those of two forms in the versions that the field's name says.
                        unsafe {
                            std::mem::transmute::<
                                *mut c_void,
                                unsafe extern "C" fn($($argument),*) $(-> $result)?,
                            >(address)
                        }
                    },)+
                })
            }
        }
    };
}

functions! {
    register_vcpu_tb_trans_cb = c"qemu_plugin_register_vcpu_tb_trans_cb":
        fn(PluginId, extern "C" fn(PluginId, *mut Tb));
    register_vcpu_tb_exec_cb = c"qemu_plugin_register_vcpu_tb_exec_cb":
        fn(*mut Tb, ExecCallback, c_int, *mut c_void);
    register_vcpu_insn_exec_cb = c"qemu_plugin_register_vcpu_insn_exec_cb":
        fn(*mut TbInsn, ExecCallback, c_int, *mut c_void);
    register_vcpu_mem_cb = c"qemu_plugin_register_vcpu_mem_cb":
        fn(*mut TbInsn, MemCallback, c_int, c_int, *mut c_void);
    register_atexit_cb = c"qemu_plugin_register_atexit_cb":
        fn(PluginId, extern "C" fn(PluginId, *mut c_void), *mut c_void);
    register_vcpu_tb_trans_cb_from_7 = c"qemu_plugin_register_vcpu_tb_trans_cb":
        fn(PluginId, extern "C" fn(*mut Tb, *mut c_void), *mut c_void);
    register_atexit_cb_from_7 = c"qemu_plugin_register_atexit_cb":
        fn(PluginId, extern "C" fn(*mut c_void), *mut c_void);
    tb_n_insns = c"qemu_plugin_tb_n_insns": fn(*const Tb) -> usize;
    tb_vaddr = c"qemu_plugin_tb_vaddr": fn(*const Tb) -> u64;
    tb_get_insn = c"qemu_plugin_tb_get_insn": fn(*const Tb, usize) -> *mut TbInsn;
    insn_data_to_2 = c"qemu_plugin_insn_data": fn(*const TbInsn) -> *const u8;
    insn_data_from_3 = c"qemu_plugin_insn_data":
        fn(*const TbInsn, *mut c_void, usize) -> usize;
    insn_size = c"qemu_plugin_insn_size": fn(*const TbInsn) -> usize;
}

#[cfg(test)]
mod tests {
    use std::ffi::OsStr;

    use super::version_to_ask_for;

    #[test]
    fn a_numeric_variable_or_the_hosts_newest_function_decides_the_version() {
        let first = [c"qemu_plugin_insn_data"].as_slice();
        let second = [c"qemu_plugin_scoreboard_new"].as_slice();
        let fourth = [second[0], c"qemu_plugin_read_memory_vaddr"];
        for (variable, functions, version) in [
            (None, first, 1),
            (None, second, 2),
            (None, &fourth, 4),
            (Some("9"), &fourth, 9),
            (Some("nine"), first, 1),
        ] {
            let has = |name: &std::ffi::CStr| functions.contains(&name);
            assert_eq!(version_to_ask_for(variable.map(OsStr::new), has), version);
        }
    }
}
