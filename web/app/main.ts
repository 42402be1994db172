// SPDX-License-Identifier: Apache-2.0
import './base.css';
import './adoption';
import './run_bar';
import './rave_app';
