#include "model/papers/networks/controllers_config.h"

#include "model/core/files/json_struct.h"

namespace choreo {

CHOREO_JSON_FIELDS(ControllersConfig, name, history_frames, max_transition_frames, window, heads,
                   width, layers, feed_forward, controller, encoder_hidden, encoding, lstm,
                   decoder_hidden, residual, absolute_position, relative_position, two_lstms,
                   transformers, root_decoder, velocity_factors, key_loss)

}  // namespace choreo
