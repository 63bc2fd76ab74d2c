# CPack runs this on the folders of the packages before it packs them. It adds the files that Debian requires of every
# package, compresses man pages, and gives all files the same time and the usual permissions, so that the same version
# always gives the same bytes.
set(epoch $ENV{SOURCE_DATE_EPOCH})
if(NOT epoch)
  execute_process(COMMAND git -C ${CPACK_RELIEVO_SOURCE} log -1 --format=%ct OUTPUT_VARIABLE epoch
    OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
set(ENV{LC_ALL} C)
execute_process(COMMAND date -u -R -d @${epoch} OUTPUT_VARIABLE date OUTPUT_STRIP_TRAILING_WHITESPACE)

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component})
  set(doc ${root}/usr/share/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  file(MAKE_DIRECTORY ${doc})
  configure_file(${CPACK_RELIEVO_SOURCE}/packaging/copyright ${doc}/copyright COPYONLY)
  configure_file(${CPACK_RELIEVO_SOURCE}/CHANGELOG.md ${doc}/NEWS COPYONLY)
  file(WRITE ${doc}/changelog "relievo (${CPACK_PACKAGE_VERSION}) bookworm; urgency=medium\n\n"
    "  * NEWS.gz says what has changed.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  execute_process(COMMAND gzip -9n ${doc}/changelog ${doc}/NEWS COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB pages ${root}/usr/share/man/man1/*.1)
  if(pages)
    execute_process(COMMAND gzip -9n ${pages} COMMAND_ERROR_IS_FATAL ANY)
  endif()
  execute_process(COMMAND chmod -R u=rwX,go=rX ${root} COMMAND_ERROR_IS_FATAL ANY)
  execute_process(COMMAND find ${root} -exec touch -h -d @${epoch} {} + COMMAND_ERROR_IS_FATAL ANY)
endforeach()
