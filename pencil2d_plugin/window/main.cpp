// lampblack-window [FILE]: the lamp for the drawings of any program.
#include "plugin/studio.h"
#include "window/window_host.h"
#include "worker/worker_session.h"

#include <QApplication>
#include <QCommandLineParser>

using namespace lampblack;

int main(int argc, char** argv)
{
    QApplication application(argc, argv);
    QCoreApplication::setApplicationName(QStringLiteral("lampblack-window"));
    QCoreApplication::setApplicationVersion(QStringLiteral(LAMPBLACK_VERSION));
    QCommandLineParser parser;
    parser.setApplicationDescription(
        QStringLiteral("Light the drawings of any program. When they are saved there, the light follows."));
    parser.addHelpOption();
    parser.addVersionOption();
    parser.addPositionalArgument(
        QStringLiteral("file"),
        QStringLiteral("A picture, folder, walk.%04d.png, .pclx, .ora, .psd or .kra."),
        QStringLiteral("[file]"));
    parser.process(application);

    const QString geometry = QStringLiteral("lampblack.window.geometry");
    const QString docks = QStringLiteral("lampblack.window.docks");
    MainWindow window;
    WindowHost host(window);
    auto worker = std::make_unique<WorkerSession>();
    // Without a renderer nothing can be read.
    QObject::connect(worker.get(), &Worker::stateChanged, &host,
                     [&host](Worker::State state)
                     {
                         if (state == Worker::State::Ready)
                             host.retry();
                     });
    Studio studio(host, std::move(worker), &application);
    window.resize(1280, 860);
    window.restoreGeometry(host.remembered(geometry, {}).toByteArray());
    window.restoreState(host.remembered(docks, {}).toByteArray());
    window.show();
    if (!host.remembered(docks, {}).isValid())
        host.giveDocksRoom();
    if (!parser.positionalArguments().isEmpty())
        host.openProject(parser.positionalArguments().first());
    const int code = QApplication::exec();
    host.remember(geometry, window.saveGeometry());
    host.remember(docks, window.saveState());
    return code;
}
