# SPDX-FileCopyrightText: 2026 The Keyline Authors
# SPDX-License-Identifier: Apache-2.0
# Whether a job of Afanasy's has what its protocol asks for, each of its kind; and waits for blocks that there are.
def text: type == "string" and . != "";
def whole: type == "number" and . == floor;
(.job | (.name | text) and (.user_name | text) and (.host_name | text) and (.blocks | length > 0))
and ([.job.blocks[].name] as $names | all(.job.blocks[];
    (.name | text) and (.service | text) and (.parser | text) and (.working_directory | text)
    and (.command | text and contains("@#@"))
    and all(.need_memory, .need_cpu_cores, .errors_retries; whole)
    and ((.frames_per_task // 1) | whole)
    and (.tasks | length > 0 and all(.[]; (.name | text) and (.command | text)))
    and (.depend_mask == null or (.depend_mask as $mask | any($names[]; . == $mask)))))
