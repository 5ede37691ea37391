/** Where fields stand in the structs of nade.h; web/module.cpp checks them against the compiler. */

export const JOINT_COUNT = 26;
/** Floats of a joint: rotation x y z w, position x y z, radius. */
export const JOINT_FLOATS = 8;
export const HAND_FLOATS = JOINT_COUNT * JOINT_FLOATS;

export const PLACEMENT_BYTES = 32;
export const FEEL_BYTES = 48;
export const OPTIONS_BYTES = 40;
export const CONTACT_BYTES = 56;
export const RESULT_BYTES = 2056;
export const RESULT_JOINTS = 16;
export const RESULT_VELOCITIES = 848;
export const RESULT_CONTACTS = 1160;
export const MESH_BYTES = 32;
export const MESH_REPORT_BYTES = 32;
export const SURFACE_POINT_BYTES = 56;
export const GROUP_MEMBER_BYTES = 36;
export const HAND_MESH_BYTES = 40;
