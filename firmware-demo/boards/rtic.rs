//! The control loop as a hardware task of RTIC.
//!
//! The arm starts on its brake. The button starts it if every joint is near the start of its
//! motion. A tick that does not end within its period feeds no watchdog; 20 of them restart the
//! processor, which sets the brake.

#[rtic::app(device = crate::pins::chip::pac, peripherals = true)]
mod app {
    use motion_control::{limits::Mode, safety::Watchdog};

    use crate::board::{self, Gains, Law, Motion, Operator, TICK};
    use crate::log::{Log, impossible};
    use crate::pins::chip::{Period, Starved};
    use crate::pins::{self, Button, Connected, Devices, Kept, Light, connect, is_pressed};

    /// Ticks a second.
    const RATE: u32 = (1.0 / TICK + 0.5) as u32;

    #[shared]
    struct Shared {}

    type Detect = &'static mut board::Found;
    type Control = pins::Control<Detect>;

    /// The loop, for the tick.
    struct Own(&'static mut Control);

    // SAFETY: start-up gives the loop to the tick's interrupt, and nothing else has a part of it.
    unsafe impl Send for Own {}

    #[local]
    struct Local {
        // In their places already: moved through the stack, they would take as much of it again.
        control: Own,
        motion: &'static Motion,
        period: Period,
        watchdog: Starved,
        button: Button,
        light: Light,
        log: Log,
        operator: Operator,
    }

    // Not inlined, as all that follows: start-up then needs the stack of one of them.
    #[inline(never)]
    fn place_detectors(place: &'static mut Option<board::Found>, motion: &Motion) -> Detect {
        place.insert(board::detectors(motion))
    }

    #[inline(never)]
    fn place_control(
        place: &'static mut Option<Control>,
        devices: Devices,
        gains: Gains,
        detectors: Detect,
        motion: &Motion,
    ) -> Option<&'static mut Control> {
        let control = board::on_brake(devices, gains, detectors, motion);
        let control = control.map_err(|error| impossible(&error)).ok()?;
        Some(place.insert(control))
    }

    #[inline(never)]
    fn gains() -> Gains {
        board::gains()
    }

    #[init(local = [
        kept: Kept = Kept::NONE,
        memory: Option<board::Found> = None,
        place: Option<Control> = None,
        path: Motion = Motion::REST,
    ])]
    fn init(cx: init::Context) -> (Shared, Local) {
        let Connected { devices, button, light, timer, watchdog, mut rcc } =
            connect(cx.device, cx.local.kept);
        let motion = cx.local.path;
        let planned = board::plan(motion).map_err(|error| impossible(&error));
        let detectors = place_detectors(cx.local.memory, motion);
        let control = place_control(cx.local.place, devices, gains(), detectors, motion);
        let (Ok(()), Some(control)) = (planned, control) else {
            // The brake is set, the drives have no torque, and the light stays off.
            loop {
                cortex_m::asm::wfi();
            }
        };
        let Some(period) = Period::start(timer, RATE, &mut rcc) else {
            loop {
                cortex_m::asm::wfi();
            }
        };
        let local = Local {
            control: Own(control),
            motion,
            period,
            watchdog: Starved::start(watchdog),
            button,
            light,
            log: Log::new(),
            operator: Operator::new(motion),
        };
        (Shared {}, local)
    }

    #[task(
        binds = TIM2,
        local = [
            control, motion, period, watchdog, button, light, log, operator,
            count: u32 = 0,
        ],
        priority = 2
    )]
    fn tick(cx: tick::Context) {
        let local = cx.local;
        let (control, motion): (_, &Motion) = (&mut local.control.0, local.motion);
        local.period.begin();
        *local.count = local.count.wrapping_add(1);
        let now = *local.count;
        // A period that has ended since then is pending.
        let count = || now.wrapping_add(u32::from(local.period.has_ended()));
        let (telemetry, completed) = control.tick_at::<Law, _, ()>(motion, &(), count);
        if let Some(completed) = completed {
            local.watchdog.feed(completed);
        }
        let (mode, fault) = (telemetry.status.mode, telemetry.status.fault);
        local.log.tick(&telemetry);
        if !matches!(mode, Mode::Full) || fault.is_some() {
            let pressed = matches!(mode, Mode::Stopped) && is_pressed(local.button);
            let say = |line| local.log.say(line);
            // The arm stays on its brake without drives, too far from the motion's start, or
            // without a measurement.
            let now = (now, &telemetry.status);
            if let Some(reason) = local.operator.tick(now, control, motion, pressed, say) {
                local.log.refused(reason);
            }
        }
        local.light.set_state(matches!(mode, Mode::Full).into());
    }
}
