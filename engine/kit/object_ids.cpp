// SPDX-FileCopyrightText: 2026 The Keyline Authors
// SPDX-License-Identifier: Apache-2.0
#include "engine/kit/object_ids.h"

#include "engine/node/ids.h"

namespace keyline {

ObjectIds find_object_ids(Builder& builder, const Stream& stream, std::string_view layer) {
    if (stream.channels.size() != 1) {
        Cryptomatte crypto = find_cryptomatte(builder, stream, layer);
        std::vector<ValueRef> values = crypto.values();
        return {std::move(crypto), false, std::move(values)};
    }
    if (!layer.empty())
        builder.bad_parameter("layer", "the input is one channel of ids, and no Cryptomatte",
                              "leave 'layer' out, or connect the whole image");
    const StreamChannel& ids = stream.channels[0];
    if (ids.cryptomatte) refuse_half(builder, ids.value, ids.cryptomatte->layers);
    return {{}, ids.integer, {ids.value}};
}

Link link_depth(Builder& builder, const Input& depth) {
    const Stream stream = builder.input(depth);
    if (stream.find("X") && stream.find("Y"))
        builder.bad_parameter("depth", "X Y Z are no depth", "select the depth pass, as in \"id:Depth\"");
    return {stream, take_channels(builder, stream, matte("Z"))};
}

}  // namespace keyline
