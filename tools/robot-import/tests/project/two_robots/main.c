/* Two robots in one program, and finite inputs of which a result is not. */
#include "board.h"
#include "left_arm.h"
#include "right_arm.h"

static int good = 1;

static void expect(const char *what, int32_t found, int32_t expected)
{
    if (found != expected) {
        print(what);
        print(": ");
        print_integer(found);
        print(" instead of ");
        print_integer(expected);
        print("\n");
        good = 0;
    }
}

static int is_finite(float x)
{
    return x - x == 0.0f;
}

/* One velocity, acceleration or position of the larger robot that is far too large. */
static void too_much(const char *what, int list, float value, int32_t expected)
{
    right_arm_state state = {{0.1f, 0.2f, 0.3f, 0.4f}, {0}, {0}};
    float torque[RIGHT_ARM_JOINTS], acceleration[RIGHT_ARM_JOINTS], given[RIGHT_ARM_JOINTS] = {1, 1, 1, 1};
    for (int joint = 0; joint < RIGHT_ARM_JOINTS; joint++) {
        torque[joint] = acceleration[joint] = 42.0f;
    }
    float *of[] = {state.q, state.qd, state.qdd};
    of[list][1] = of[list][2] = value;
    int32_t inverse = right_arm_inverse_dynamics(&state, torque);
    int32_t forward = right_arm_forward_dynamics(&state, given, acceleration);
    expect(what, inverse, expected);
    for (int joint = 0; joint < RIGHT_ARM_JOINTS; joint++) {
        good &= inverse == RIGHT_ARM_OK ? is_finite(torque[joint]) : torque[joint] == 42.0f;
        good &= forward == RIGHT_ARM_OK ? is_finite(acceleration[joint]) : acceleration[joint] == 42.0f;
    }
}

int main(void)
{
    static left_arm_controller one;
    static right_arm_controller other;
    static left_arm_config of_one;
    static right_arm_config of_other;
    left_arm_command command;
    right_arm_where where;
    float q[LEFT_ARM_JOINTS] = {0.5f}, torque[LEFT_ARM_JOINTS];

    expect("gravity", left_arm_gravity(q, torque), LEFT_ARM_OK);
    good &= torque[0] > 4.6f && torque[0] < 4.8f; /* 9.81 sin(0.5) */
    too_much("q 3e38", 0, 3e38f, RIGHT_ARM_ANGLE);
    too_much("q -3e38", 0, -3e38f, RIGHT_ARM_ANGLE);
    too_much("q 1e7", 0, 1e7f, RIGHT_ARM_ANGLE);
    too_much("q 101", 0, 101.0f, RIGHT_ARM_ANGLE);
    too_much("q 99", 0, 99.0f, RIGHT_ARM_OK);
    too_much("qd 1e20", 1, 1e20f, RIGHT_ARM_OVERFLOW);
    too_much("qd 1e30", 1, 1e30f, RIGHT_ARM_OVERFLOW);
    too_much("qd 1", 1, 1.0f, RIGHT_ARM_OK);

    expect("configuration", left_arm_config_of_description(1e-3f, 25.0f, &of_one), LEFT_ARM_OK);
    expect("configuration", right_arm_config_of_description(1e-3f, 25.0f, &of_other), RIGHT_ARM_OK);
    expect("memory", left_arm_controller_command(&one, &command), LEFT_ARM_MEMORY);
    good &= command.brake && !command.enable && command.torque[0] == 0.0f;
    expect("init", left_arm_controller_init(&one, sizeof one, &of_one, 0), LEFT_ARM_OK);
    of_other.torque[3] = -1.0f;
    expect("init", right_arm_controller_init(&other, sizeof other, &of_other, &where), RIGHT_ARM_CONFIG);
    good &= where.field == RIGHT_ARM_FIELD_TORQUE && where.joint == 3;
    /* The controller of one robot is none of the other. */
    expect("other", right_arm_controller_stop((right_arm_controller *)(void *)&one), RIGHT_ARM_MEMORY);
    expect("stop", left_arm_controller_stop(&one), LEFT_ARM_OK);
    print(good ? "good\n" : "error: a status or result is wrong\n");
    return !good;
}
