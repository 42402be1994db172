// SPDX-License-Identifier: Apache-2.0
#include "ros_schemas.hpp"

#define RAVE_DEPENDENCY(name)                                                          \
  "================================================================================\n" \
  "MSG: " name "\n"
#define RAVE_TIME RAVE_DEPENDENCY("builtin_interfaces/Time") "int32 sec\nuint32 nanosec\n"
#define RAVE_HEADER \
  RAVE_DEPENDENCY("std_msgs/Header") "builtin_interfaces/Time stamp\nstring frame_id\n"
#define RAVE_VECTOR3 RAVE_DEPENDENCY("geometry_msgs/Vector3") "float64 x\nfloat64 y\nfloat64 z\n"
// `version` is the layout version; it also aligns the array after it to 8.
#define RAVE_STEP "builtin_interfaces/Time stamp\nuint64 step\nuint32 version\n"

namespace rave::record {

const RosSchema kRunSchema{
    "rave_msgs/msg/Run",
    "string scenario\nstring started\nuint64 seed\nfloat64 step_s\n"
    "rave_msgs/Version[] versions\nrave_msgs/Robot[] robots\nrave_msgs/Sensor[] sensors\n"
    "bool[] sensors_virtual\n"
    RAVE_DEPENDENCY("rave_msgs/Version") "string name\nstring version\n"
    RAVE_DEPENDENCY("rave_msgs/Robot") "uint32 id\nstring name\nstring kind\nstring team\n"
    RAVE_DEPENDENCY("rave_msgs/Sensor")
    "uint32 robot\nuint32 sensor\nstring name\nuint32 kind\nfloat64 x_m\nfloat64 y_m\n"
    "float64 yaw_rad\nfloat64 z_m\nfloat64 period_s\nfloat64 range_min_m\nfloat64 range_max_m\n"
    "float64 cone_rad\nfloat64[] bearings_rad\n"};

const RosSchema kEndSchema{
    "rave_msgs/msg/End",
    "builtin_interfaces/Time stamp\nuint64 steps\nbool has_hash\nuint64 hash\n" RAVE_TIME};

const RosSchema kPosesSchema{
    "rave_msgs/msg/Poses",
    RAVE_STEP
    "rave_msgs/RobotPose[] robots\nuint32 reserved\nrave_msgs/TruePose[] true_poses\n" RAVE_TIME
    RAVE_DEPENDENCY("rave_msgs/RobotPose")
    "uint32 HAS_REPORTED=1\nuint32 HAS_TRUE=2\nuint32 TRUE_IS_REPORTED=4\n"
    "uint32 robot\nuint32 flags\nfloat64 x\nfloat64 y\nfloat64 yaw\nfloat64 vx\nfloat64 vy\n"
    "float64 wz\n"
    RAVE_DEPENDENCY("rave_msgs/TruePose")
    "uint32 robot\nuint32 reserved\nfloat64 x\nfloat64 y\nfloat64 yaw\n"};

const RosSchema kPerceptsSchema{
    "rave_msgs/msg/Percepts",
    RAVE_STEP "rave_msgs/Percept[] percepts\nuint8[] records\n" RAVE_TIME
    RAVE_DEPENDENCY("rave_msgs/Percept")
    "uint8 RESULT=0\nuint8 REAL=1\nuint8 VIRTUAL=2\n"
    "uint32 robot\nuint16 sensor\nuint8 kind\nuint8 part\nint64 stamp_ns\nuint32 sequence\n"
    "uint32 count\nuint32 fresh\nuint32 dropped\nuint32 offset\nuint32 size\nuint32 robots\n"
    "uint32 reserved\n"};

const RosSchema kCommandsSchema{
    "rave_msgs/msg/Commands",
    RAVE_STEP "rave_msgs/Command[] commands\nuint8[] records\n" RAVE_TIME
    RAVE_DEPENDENCY("rave_msgs/Command")
    "uint32 robot\nuint32 controller\nuint32 offset\nuint32 size\nuint32 robots\n"
    "uint32 reserved\n"};

const RosSchema kActuatorsSchema{
    "rave_msgs/msg/Actuators",
    RAVE_STEP "rave_msgs/ActuatorCommand[] commands\nuint8[] records\n" RAVE_TIME RAVE_DEPENDENCY(
        "rave_msgs/ActuatorCommand") "uint32 robot\nuint32 actuator\nuint32 offset\nuint32 size\n"};

const RosSchema kHashSchema{"rave_msgs/msg/StepHash",
                            "builtin_interfaces/Time stamp\nuint64 step\nuint64 hash\n" RAVE_TIME};

const RosSchema kRadioSchema{
    "rave_msgs/msg/Radio",
    RAVE_STEP "rave_msgs/Packet[] packets\nuint8[] records\n" RAVE_TIME
    RAVE_DEPENDENCY("rave_msgs/Packet")
    "int64 sent_ns\nint64 received_ns\nuint32 from_robot\nuint32 to_robot\nuint16 transmitter\n"
    "uint16 delivered\nuint32 offset\nuint32 size\nuint32 reserved\n"};

const RosSchema kEventSchema{
    "rave_msgs/msg/Event",
    "builtin_interfaces/Time stamp\nuint64 step\nuint32 robot\nstring kind\nstring text\n"
    "float64[] values\n" RAVE_TIME};

const RosSchema kInputSchema{"rave_msgs/msg/Input",
                             "builtin_interfaces/Time stamp\nuint64 step\nstring kind\n"
                             "string robot\nstring key\nstring value\nstring by\n" RAVE_TIME};

const RosSchema kChatSchema{
    "rave_msgs/msg/Chat",
    "builtin_interfaces/Time stamp\nuint64 step\nuint64 number\nstring sender\nstring role\n"
    "string addressee\nstring name\nstring text\n" RAVE_TIME};

const RosSchema kShadowSchema{
    "rave_msgs/msg/Shadow",
    "builtin_interfaces/Time stamp\nuint64 step\nuint32 robot\nfloat64[3] robot_pose\n"
    "float64[3] shadow_pose\nfloat64 m\nfloat64 rad\nfloat64[] readings\n" RAVE_TIME};

const RosSchema kVariancesSchema{
    "rave_msgs/msg/Variances",
    RAVE_STEP "rave_msgs/PoseVariance[] robots\n" RAVE_TIME RAVE_DEPENDENCY(
        "rave_msgs/PoseVariance") "uint32 robot\nuint32 reserved\nfloat64 xy_m2\n"
                                  "float64 yaw_rad2\n"};

const RosSchema kLogSchema{
    "rcl_interfaces/msg/Log",
    "byte DEBUG=10\nbyte INFO=20\nbyte WARN=30\nbyte ERROR=40\nbyte FATAL=50\n"
    "builtin_interfaces/Time stamp\nuint8 level\nstring name\nstring msg\nstring file\n"
    "string function\nuint32 line\n" RAVE_TIME};

const RosSchema kTfSchema{
    "tf2_msgs/msg/TFMessage",
    "geometry_msgs/TransformStamped[] transforms\n"
    RAVE_DEPENDENCY("geometry_msgs/TransformStamped")
    "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"
    RAVE_HEADER RAVE_TIME
    RAVE_DEPENDENCY("geometry_msgs/Transform")
    "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n" RAVE_VECTOR3
    RAVE_DEPENDENCY("geometry_msgs/Quaternion") "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"};

const RosSchema kLaserScanSchema{
    "sensor_msgs/msg/LaserScan",
    "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
    "float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\n"
    "float32[] ranges\nfloat32[] intensities\n" RAVE_HEADER RAVE_TIME};

const RosSchema kTwistSchema{
    "geometry_msgs/msg/Twist",
    "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n" RAVE_VECTOR3};

}  // namespace rave::record

#undef RAVE_DEPENDENCY
#undef RAVE_TIME
#undef RAVE_HEADER
#undef RAVE_VECTOR3
#undef RAVE_STEP
