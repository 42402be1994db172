// SPDX-License-Identifier: Apache-2.0
import './base.css';
import './adoption';
import '../panels/world/world_panel';
import '../panels/robots/robots_panel';
import '../panels/sensors/sensors_panel';
import '../panels/log/log_panel';
import '../panels/hosts/hosts_panel';
import '../panels/people/super_user_panel';
import '../panels/map/map_panel';
import '../panels/probe/probe_panel';
import '../panels/robot/robot_panel';
import '../panels/joystick/joystick_panel';
import '../panels/chat/chat_panel';
import './run_bar';
import './rave_app';
