// SPDX-License-Identifier: Apache-2.0
export {TopStage as PerspectiveStage} from '../top_stage';
