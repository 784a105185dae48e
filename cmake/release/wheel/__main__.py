from foretouch._command import main

main()
