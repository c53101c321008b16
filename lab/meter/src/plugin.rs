//! The plugin itself: what QEMU calls, and what it then calls back.

use std::collections::HashMap;
use std::ffi::{CStr, c_char, c_int, c_uint, c_void};
use std::path::PathBuf;
use std::ptr;
use std::sync::atomic::{AtomicI32, AtomicPtr, Ordering};

use crate::block::{Block, Mark};
use crate::decode::decode;
use crate::ffi::{self, Info, PluginId, Qemu, Tb};
use crate::insn::Insn;
use crate::meter::Meter;
use crate::samples::format_samples;

struct Plugin {
    qemu: Qemu,
    /// The version of the interface that QEMU speaks, whichever was requested.
    version: c_int,
    out: PathBuf,
    meter: Meter<'static>,
    /// Blocks by address and length, so that code translated again takes no new
    /// memory. They are never freed: QEMU may run them until it exits.
    blocks: HashMap<(u32, usize), Vec<&'static Block>>,
    /// Checkpoints passed since the start.
    checkpoints: u64,
    /// Its value when the current block was entered.
    checkpoints_at_entry: u64,
}

/// Set once by `qemu_plugin_install`, before QEMU can call anything else.
static PLUGIN: AtomicPtr<Plugin> = AtomicPtr::new(ptr::null_mut());

/// The requested version of the interface. QEMU reads it when it has loaded the library, before it
/// calls anything in it, and each QEMU refuses versions that the other one takes: so it is written
/// while the library is loaded, by [`choose_version`].
#[allow(non_upper_case_globals, reason = "QEMU looks for this name")]
#[unsafe(no_mangle)]
pub static qemu_plugin_version: AtomicI32 = AtomicI32::new(1);

extern "C" fn choose_version() {
    let requested = std::env::var_os(crate::INTERFACE);
    let version = ffi::version_to_ask_for(requested.as_deref(), ffi::host_has);
    qemu_plugin_version.store(version, Ordering::Relaxed);
}

/// The loader calls what stands in this section.
#[used]
#[cfg_attr(target_vendor = "apple", unsafe(link_section = "__DATA,__mod_init_func"))]
#[cfg_attr(not(target_vendor = "apple"), unsafe(link_section = ".init_array"))]
static CHOOSE_VERSION: extern "C" fn() = choose_version;

/// Installs the plugin; anything but 0 makes QEMU exit.
///
/// # Safety
///
/// For QEMU to call, with a valid `info` and `argc` strings in `argv`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn qemu_plugin_install(
    id: PluginId,
    info: *const Info,
    argc: c_int,
    argv: *const *const c_char,
) -> c_int {
    // SAFETY: QEMU passes a valid description.
    let info = unsafe { &*info };
    let arguments = (0..argc.max(0) as usize).map(|index| {
        // SAFETY: QEMU passes `argc` strings that end in a zero.
        unsafe { CStr::from_ptr(*argv.add(index)) }.to_string_lossy().into_owned()
    });
    match install(id, info, arguments) {
        Ok(()) => 0,
        Err(message) => {
            eprintln!("cycle-meter: {message}");
            1
        }
    }
}

fn install(
    id: PluginId,
    info: &Info,
    arguments: impl Iterator<Item = String>,
) -> Result<(), String> {
    let mut out = None;
    for argument in arguments {
        match argument.split_once('=') {
            Some(("out", path)) if !path.is_empty() => out = Some(PathBuf::from(path)),
            _ => return Err(format!("unknown argument `{argument}`; expected out=PATH")),
        }
    }
    let out = out.ok_or("expected the argument out=PATH")?;
    if !info.system_emulation || info.max_vcpus != 1 {
        return Err("needs a machine with one processor".into());
    }
    let qemu = Qemu::find().map_err(|name| format!("this QEMU does not offer {name:?}"))?;
    let plugin = Box::new(Plugin {
        qemu,
        version: info.version_cur,
        out,
        meter: Meter::new(),
        blocks: HashMap::new(),
        checkpoints: 0,
        checkpoints_at_entry: 0,
    });
    PLUGIN.store(Box::into_raw(plugin), Ordering::Release);
    // SAFETY: the callbacks are functions and live as long as the program.
    unsafe {
        if info.version_cur >= ffi::USER_DATA {
            (qemu.register_vcpu_tb_trans_cb_from_7)(id, translated_from_7, ptr::null_mut());
            (qemu.register_atexit_cb_from_7)(id, exiting_from_7, ptr::null_mut());
        } else {
            (qemu.register_vcpu_tb_trans_cb)(id, translated);
            (qemu.register_atexit_cb)(id, exiting, ptr::null_mut());
        }
    }
    Ok(())
}

/// The plugin, for the duration of a callback.
///
/// # Safety
///
/// Only once in a callback, and only in callbacks.
unsafe fn plugin() -> &'static mut Plugin {
    // SAFETY: installed before any callback, never freed. There is one processor,
    // its callbacks run one after the other on its thread, and QEMU stops it before
    // it exits from another thread; so no other reference is alive.
    unsafe { &mut *PLUGIN.load(Ordering::Relaxed) }
}

/// QEMU has translated a block.
extern "C" fn translated(_: PluginId, tb: *mut Tb) {
    // SAFETY: the only call in this callback.
    let plugin = unsafe { plugin() };
    let qemu = plugin.qemu;
    // SAFETY: the block is valid during this callback.
    let (start, insns) = unsafe {
        let insns = read(&qemu, plugin.version, tb);
        ((qemu.tb_vaddr)(tb) as u32, insns)
    };
    let block = plugin.intern(start, insns);
    // SAFETY: the block is valid during this callback and the indices lie within
    // it; what the callbacks get is never freed, and is only read by them.
    unsafe {
        (qemu.register_vcpu_tb_exec_cb)(tb, entered, ffi::NO_REGISTERS, user_data(block));
        for &index in block.checkpoints() {
            let insn = (qemu.tb_get_insn)(tb, index);
            (qemu.register_vcpu_insn_exec_cb)(insn, passed, ffi::NO_REGISTERS, ptr::null_mut());
        }
        let loads = block.insns().iter().enumerate().filter(|(_, insn)| insn.may_load_flash());
        for (index, _) in loads {
            let insn = (qemu.tb_get_insn)(tb, index);
            let index = ptr::without_provenance_mut(index);
            (qemu.register_vcpu_mem_cb)(insn, loaded, ffi::NO_REGISTERS, ffi::ACCESSES, index);
        }
        for mark in block.marks() {
            let insn = (qemu.tb_get_insn)(tb, mark.index);
            (qemu.register_vcpu_insn_exec_cb)(insn, marked, ffi::NO_REGISTERS, user_data(mark));
        }
    }
}

/// QEMU has translated a block, and speaks version 7 or later.
extern "C" fn translated_from_7(tb: *mut Tb, _: *mut c_void) {
    translated(0, tb);
}

fn user_data<T>(data: &'static T) -> *mut c_void {
    ptr::from_ref(data).cast_mut().cast()
}

/// The instructions of a block.
///
/// # Safety
///
/// `tb` must be a block that is being translated.
unsafe fn read(qemu: &Qemu, version: c_int, tb: *const Tb) -> Vec<Insn> {
    // SAFETY: the caller's promise.
    let count = unsafe { (qemu.tb_n_insns)(tb) };
    (0..count)
        .map(|index| {
            let mut code = [0; 4];
            // SAFETY: the index is in range; QEMU copies no more than there is room for, and in
            // the versions before it did so it gives as many bytes as it says.
            let size = unsafe {
                let insn = (qemu.tb_get_insn)(tb, index);
                if version >= ffi::COPIES {
                    (qemu.insn_data_from_3)(insn, code.as_mut_ptr().cast(), code.len())
                } else {
                    let size = (qemu.insn_size)(insn).min(code.len());
                    let data = (qemu.insn_data_to_2)(insn);
                    ptr::copy_nonoverlapping(data, code.as_mut_ptr(), size);
                    size
                }
            };
            // QEMU 7.2 may give a halfword too many at the end of a page, never one too few.
            code[size.min(4)..].fill(0);
            let [first, second] = [0, 2].map(|at| u16::from_le_bytes([code[at], code[at + 1]]));
            decode(first, second)
        })
        .collect()
}

impl Plugin {
    /// The block of these instructions, made if it is new.
    fn intern(&mut self, start: u32, insns: Vec<Insn>) -> &'static Block {
        let known = self.blocks.entry((start, insns.len())).or_default();
        if let Some(block) = known.iter().find(|block| block.insns() == insns) {
            return block;
        }
        let block: &Block = Box::leak(Box::new(Block::new(start, insns)));
        known.push(block);
        block
    }
}

/// A block starts.
extern "C" fn entered(_: c_uint, block: *mut c_void) {
    // SAFETY: the only call in this callback.
    let plugin = unsafe { plugin() };
    // SAFETY: registered with a block that is never freed.
    let block = unsafe { &*block.cast::<Block>() };
    let passed = plugin.checkpoints - plugin.checkpoints_at_entry;
    plugin.checkpoints_at_entry = plugin.checkpoints;
    plugin.meter.enter(block, passed as usize);
}

/// An instruction that tells how far a block came is executed.
extern "C" fn passed(_: c_uint, _: *mut c_void) {
    // SAFETY: the only call in this callback.
    let plugin = unsafe { plugin() };
    plugin.checkpoints += 1;
}

/// An instruction loads from memory.
extern "C" fn loaded(_: c_uint, _: ffi::MemInfo, address: u64, index: *mut c_void) {
    // SAFETY: the only call in this callback.
    let plugin = unsafe { plugin() };
    plugin.meter.load(index.addr(), address as u32);
}

/// A marker is executed.
extern "C" fn marked(_: c_uint, mark: *mut c_void) {
    // SAFETY: the only call in this callback.
    let plugin = unsafe { plugin() };
    // SAFETY: registered with a mark in a block that is never freed.
    plugin.meter.mark(unsafe { &*mark.cast::<Mark>() });
}

/// QEMU exits, and speaks version 7 or later.
extern "C" fn exiting_from_7(_: *mut c_void) {
    exiting(0, ptr::null_mut());
}

/// QEMU exits.
extern "C" fn exiting(_: PluginId, _: *mut c_void) {
    // SAFETY: the only call in this callback.
    let plugin = unsafe { plugin() };
    let text = format_samples(plugin.meter.samples(), plugin.meter.unmatched());
    if let Err(error) = std::fs::write(&plugin.out, text) {
        eprintln!("cycle-meter: cannot write {}: {error}", plugin.out.display());
    }
}
