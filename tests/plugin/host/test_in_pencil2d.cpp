// Starts the real Pencil2D with a visitor plugin inside, with projects of known pixels.
#include "known_drawing.h"

#include <QProcess>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <QTest>

class InPencil2D : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void visitorPasses_data()
    {
        QTest::addColumn<QString>("visitor");
        QTest::addColumn<QString>("scale");
        QTest::newRow("host") << QStringLiteral("host_visitor") << QStringLiteral("1");
        QTest::newRow("host, high density") << QStringLiteral("host_visitor") << QStringLiteral("2");
        QTest::newRow("layer") << QStringLiteral("layer_visitor") << QStringLiteral("1");
    }

    void visitorPasses()
    {
        QFETCH(QString, visitor);
        QFETCH(QString, scale);
        const QString program = QStandardPaths::findExecutable(QStringLiteral("pencil2d"));
        if (program.isEmpty())
            QSKIP("pencil2d is not installed");
        QTemporaryDir home;
        QVERIFY(home.isValid() && QDir(home.path()).mkpath(QStringLiteral("tmp")));
        const QString still = home.filePath(QStringLiteral("still.pclx"));
        const QString moving = home.filePath(QStringLiteral("moving.pclx"));
        QVERIFY(known::writeProject(still, known::StillCamera));
        QVERIFY(known::writeProject(moving, known::MovingCamera));
        const QString longMove = home.filePath(QStringLiteral("long.pclx"));
        QVERIFY(known::writeProject(longMove, known::LongCamera));

        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert(QStringLiteral("HOME"), home.path());
        environment.insert(QStringLiteral("TMPDIR"), home.filePath(QStringLiteral("tmp")));
        environment.insert(QStringLiteral("XDG_RUNTIME_DIR"), home.path());
        environment.remove(QStringLiteral("XDG_CONFIG_HOME"));
        environment.insert(QStringLiteral("QT_PLUGIN_PATH"), QStringLiteral(LAMPBLACK_VISITOR_FOLDER));
        environment.insert(QStringLiteral("QT_QPA_GENERIC_PLUGINS"), visitor);
        environment.insert(QStringLiteral("QT_SCALE_FACTOR"), scale);
        environment.insert(QStringLiteral("VISITOR_MOVING_PROJECT"), moving);
        environment.insert(QStringLiteral("VISITOR_LONG_PROJECT"), longMove);
        QProcess pencil;
        pencil.setProcessEnvironment(environment);
        pencil.setProcessChannelMode(QProcess::MergedChannels);
        pencil.start(program, {still});
        constexpr int LimitMs = 100000;
        const bool ended = pencil.waitForFinished(LimitMs);
        const QByteArray told = pencil.readAll();
        if (!ended)
            pencil.kill();
        if (!ended || pencil.exitStatus() != QProcess::NormalExit || pencil.exitCode() != 0)
            QFAIL(("Inside Pencil2D:\n" + told).constData());
    }
};

QTEST_GUILESS_MAIN(InPencil2D)
#include "test_in_pencil2d.moc"
