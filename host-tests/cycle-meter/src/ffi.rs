//! QEMU's plugin interface, version 1, as far as it is used here: the declarations
//! of `qemu-plugin.h`, looked up by name when the plugin is installed. Were they
//! linked against, no ordinary program could contain this crate.

use std::ffi::{CStr, c_char, c_int, c_uint, c_void};

/// Version of the interface that the declarations below follow.
pub const VERSION: c_int = 1;

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

/// `QEMU_PLUGIN_CB_NO_REGS`: the callback does not look at registers.
pub const NO_REGISTERS: c_int = 0;

/// `QEMU_PLUGIN_INLINE_ADD_U64`.
pub const ADD_U64: c_int = 0;

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
                        // SAFETY: QEMU defines the function of this name with these
                        // types in every release that offers version 1.
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
    register_vcpu_insn_exec_inline = c"qemu_plugin_register_vcpu_insn_exec_inline":
        fn(*mut TbInsn, c_int, *mut c_void, u64);
    register_atexit_cb = c"qemu_plugin_register_atexit_cb":
        fn(PluginId, extern "C" fn(PluginId, *mut c_void), *mut c_void);
    tb_n_insns = c"qemu_plugin_tb_n_insns": fn(*const Tb) -> usize;
    tb_vaddr = c"qemu_plugin_tb_vaddr": fn(*const Tb) -> u64;
    tb_get_insn = c"qemu_plugin_tb_get_insn": fn(*const Tb, usize) -> *mut TbInsn;
    insn_data = c"qemu_plugin_insn_data": fn(*const TbInsn) -> *const u8;
    insn_size = c"qemu_plugin_insn_size": fn(*const TbInsn) -> usize;
}
