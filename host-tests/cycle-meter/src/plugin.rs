//! The plugin itself: what QEMU calls, and what it then calls back.

use std::collections::HashMap;
use std::ffi::{CStr, c_char, c_int, c_uint, c_void};
use std::path::PathBuf;
use std::ptr;
use std::sync::atomic::{AtomicPtr, Ordering};

use crate::block::{Block, Mark};
use crate::decode;
use crate::ffi::{self, Info, PluginId, Qemu, Tb};
use crate::insn::Insn;
use crate::meter::Meter;
use crate::samples::format_samples;

/// All that the plugin knows.
struct Plugin {
    qemu: Qemu,
    out: PathBuf,
    meter: Meter<'static>,
    /// Blocks by address and length, so that code translated again takes no new
    /// memory. They are never freed: QEMU may run them until it exits.
    blocks: HashMap<(u32, usize), Vec<&'static Block>>,
    /// Checkpoints passed since the start; translated code adds to it.
    checkpoints: u64,
    /// Its value when the current block was entered.
    checkpoints_at_entry: u64,
}

/// Set once by `qemu_plugin_install`, before QEMU can call anything else.
static PLUGIN: AtomicPtr<Plugin> = AtomicPtr::new(ptr::null_mut());

/// Version of the interface that this plugin was made for.
#[allow(non_upper_case_globals, reason = "QEMU looks for this name")]
#[unsafe(no_mangle)]
pub static qemu_plugin_version: c_int = ffi::VERSION;

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
        unsafe { CStr::from_ptr(*argv.add(index)) }
            .to_string_lossy()
            .into_owned()
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
        match argument.strip_prefix("out=") {
            Some(path) if !path.is_empty() => out = Some(PathBuf::from(path)),
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
        out,
        meter: Meter::default(),
        blocks: HashMap::new(),
        checkpoints: 0,
        checkpoints_at_entry: 0,
    });
    PLUGIN.store(Box::into_raw(plugin), Ordering::Release);
    // SAFETY: the callbacks are functions and live as long as the program.
    unsafe {
        (qemu.register_vcpu_tb_trans_cb)(id, translated);
        (qemu.register_atexit_cb)(id, exiting, ptr::null_mut());
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
    let (start, insns) = unsafe { ((qemu.tb_vaddr)(tb) as u32, read(&qemu, tb)) };
    let block = plugin.intern(start, insns);
    let counter = (&raw mut plugin.checkpoints).cast::<c_void>();
    // SAFETY: the block is valid during this callback and the indices lie within
    // it; what the callbacks get is never freed, and is only read by them.
    unsafe {
        (qemu.register_vcpu_tb_exec_cb)(tb, entered, ffi::NO_REGISTERS, user_data(block));
        for &index in block.checkpoints() {
            let insn = (qemu.tb_get_insn)(tb, index);
            (qemu.register_vcpu_insn_exec_inline)(insn, ffi::ADD_U64, counter, 1);
        }
        for mark in block.marks() {
            let insn = (qemu.tb_get_insn)(tb, mark.index);
            (qemu.register_vcpu_insn_exec_cb)(insn, marked, ffi::NO_REGISTERS, user_data(mark));
        }
    }
}

fn user_data<T>(data: &'static T) -> *mut c_void {
    ptr::from_ref(data).cast_mut().cast()
}

/// The instructions of a block.
///
/// # Safety
///
/// `tb` must be a block that is being translated.
unsafe fn read(qemu: &Qemu, tb: *const Tb) -> Vec<Insn> {
    // SAFETY: the caller's promise.
    let count = unsafe { (qemu.tb_n_insns)(tb) };
    (0..count)
        .map(|index| {
            // SAFETY: the index is in range, and QEMU gives as many bytes as it says.
            let code = unsafe {
                let insn = (qemu.tb_get_insn)(tb, index);
                std::slice::from_raw_parts((qemu.insn_data)(insn), (qemu.insn_size)(insn))
            };
            // QEMU 7.2 may give a halfword too many at the end of a page, never one too few.
            let halfword = |at| match code.get(at..at + 2) {
                Some(&[low, high]) => u16::from_le_bytes([low, high]),
                _ => 0,
            };
            decode::decode(halfword(0), halfword(2))
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

/// A marker is executed.
extern "C" fn marked(_: c_uint, mark: *mut c_void) {
    // SAFETY: the only call in this callback.
    let plugin = unsafe { plugin() };
    // SAFETY: registered with a mark in a block that is never freed.
    plugin.meter.mark(unsafe { &*mark.cast::<Mark>() });
}

/// QEMU exits.
extern "C" fn exiting(_: PluginId, _: *mut c_void) {
    // SAFETY: the only call in this callback.
    let plugin = unsafe { plugin() };
    let text = format_samples(plugin.meter.samples(), plugin.meter.unmatched());
    if let Err(error) = std::fs::write(&plugin.out, text) {
        eprintln!(
            "cycle-meter: cannot write {}: {error}",
            plugin.out.display()
        );
    }
}
