# SPDX-FileCopyrightText: The Hooke authors
# SPDX-License-Identifier: MIT

# Fails where docs/scene.md is not what the schema makes of it.
execute_process(COMMAND ${MAKE_PAGE} ${SOURCE}/schema/scene.json ${SOURCE}/schema/example.json
  OUTPUT_VARIABLE made COMMAND_ERROR_IS_FATAL ANY)
file(READ ${SOURCE}/docs/scene.md page)
if(NOT made STREQUAL page)
  message(FATAL_ERROR "docs/scene.md is out of date: build the target scene_reference_page")
endif()
