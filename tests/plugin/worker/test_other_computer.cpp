// WorkerSession with a worker that listens on TCP, as on another computer, if LAMPBLACK_PYTHON has one.
#include "worker/worker_session.h"

#include <QDir>
#include <QPainter>
#include <QProcess>
#include <QSignalSpy>
#include <QTcpServer>
#include <QTcpSocket>
#include <QTemporaryDir>
#include <QtTest>

using namespace lampblack;

namespace
{

constexpr int Side = 96;
constexpr int PatienceMs = 90000;

QImage ball()
{
    QImage image(Side, Side, QImage::Format_RGBA8888);
    image.fill(Qt::transparent);
    QPainter painter(&image);
    painter.setPen(QPen(Qt::black, 3));
    painter.setBrush(QColor(220, 120, 60));
    painter.drawEllipse(QPointF(Side / 2.0, Side / 2.0), Side * 0.4, Side * 0.4);
    return image;
}

} // namespace

class TestOtherComputer : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void initTestCase()
    {
        if (qEnvironmentVariable("LAMPBLACK_PYTHON").isEmpty())
        {
            QSKIP("LAMPBLACK_PYTHON names no interpreter");
        }
        qputenv("XDG_CACHE_HOME", mFolder.filePath(QStringLiteral("cache")).toLocal8Bit());
        for (const char* name : {"studio", "ana", "stranger"})
        {
            run({QStringLiteral("key"), QLatin1String(name), QStringLiteral("-o"), keys()});
        }
        QVERIFY(QDir(keys()).mkdir(QStringLiteral("admitted")));
        QVERIFY(QFile::copy(key("ana.key"), key("admitted/ana.key")));
        QTcpServer free;
        QVERIFY(free.listen(QHostAddress::LocalHost));
        mPort = free.serverPort();
        free.close();
        serve();
    }

    void init()
    {
        mImage = {};
        mProblems.clear();
    }

    void aDrawingIsLitThere()
    {
        const auto session = open(key("studio.key"), key("ana.key_secret"));
        light(*session);
        QTRY_VERIFY_WITH_TIMEOUT(session->isCurrent(mImage), PatienceMs);
        QCOMPARE(mImage.picture.size(), QSize(Side, Side));
        const QColor middle = mImage.picture.pixelColor(Side / 2, Side / 2);
        QVERIFY2(middle.red() > middle.blue(), qPrintable(middle.name()));
        QCOMPARE(session->workerPid(), 0);
        QVERIFY(mProblems.isEmpty());
    }

    void whenItReturnsThePictureReturns()
    {
        const auto session = open(key("studio.key"), key("ana.key_secret"));
        light(*session);
        QTRY_VERIFY_WITH_TIMEOUT(session->isCurrent(mImage), PatienceMs);
        mServer->kill();
        QVERIFY(mServer->waitForFinished());
        serve();
        mImage = {};
        light(*session);
        session->setScene(Scene(defaultScene(QSize(Side, Side / 2))));
        QTRY_VERIFY_WITH_TIMEOUT(session->isCurrent(mImage), PatienceMs);
        QVERIFY(mProblems.isEmpty());
    }

    void whoIsNotAdmittedIsToldInOneSentence_data()
    {
        QTest::addColumn<QString>("worker");
        QTest::addColumn<QString>("own");
        QTest::newRow("a stranger") << QStringLiteral("studio.key") << QStringLiteral("stranger.key_secret");
        QTest::newRow("the key of another")
            << QStringLiteral("stranger.key") << QStringLiteral("ana.key_secret");
    }

    void whoIsNotAdmittedIsToldInOneSentence()
    {
        QFETCH(QString, worker);
        QFETCH(QString, own);
        const auto session = open(key(worker), key(own));
        QTRY_COMPARE_WITH_TIMEOUT(mProblems.size(), 1, PatienceMs);
        QCOMPARE(mProblems[0].what, QStringLiteral("The other computer does not let you in."));
        QVERIFY(mProblems[0].remedy.contains(QFileInfo(own).completeBaseName() + QStringLiteral(".key,")));
        QCOMPARE(mProblems[0].kind, UserError::Kind::NoOtherComputer);
        QCOMPARE(session->state(), Worker::State::Absent);
    }

    void aKeyThatIsNoneIsNamed_data()
    {
        QTest::addColumn<QString>("worker");
        QTest::addColumn<QString>("own");
        QTest::addColumn<QString>("named");
        const QString studio = QStringLiteral("studio.key");
        QTest::newRow("no file") << studio << QStringLiteral("none") << QStringLiteral("none");
        QTest::newRow("no secret") << studio << QStringLiteral("ana.key") << QStringLiteral("ana.key ");
        QTest::newRow("a folder") << QStringLiteral("admitted") << QStringLiteral("ana.key_secret")
                                  << QStringLiteral("admitted");
    }

    void aKeyThatIsNoneIsNamed()
    {
        QFETCH(QString, worker);
        QFETCH(QString, own);
        QFETCH(QString, named);
        const auto session = open(key(worker), key(own));
        QTRY_COMPARE(mProblems.size(), 1);
        QVERIFY2(mProblems[0].what.startsWith(named), qPrintable(mProblems[0].what));
    }

    void whereNobodyAnswersItIsSaid()
    {
        QTcpServer deaf; // accepts, and says nothing
        QVERIFY(deaf.listen(QHostAddress::LocalHost));
        const auto session = open(key("studio.key"), key("ana.key_secret"), deaf.serverPort());
        QTRY_COMPARE_WITH_TIMEOUT(mProblems.size(), 1, PatienceMs);
        QCOMPARE(mProblems[0].what, QStringLiteral("The other computer does not answer."));
        QCOMPARE(session->state(), Worker::State::Absent);
    }

    void framesAreRenderedIntoFoldersThatBothSee()
    {
        const auto session = open(key("studio.key"), key("ana.key_secret"));
        light(*session);
        const QSignalSpy done(session.get(), &Worker::renderDone);
        const QString output = mFolder.filePath(QStringLiteral("a.%04d.png"));
        session->render(QStringLiteral("1"), output, Quality::Low);
        QTRY_COMPARE_WITH_TIMEOUT(done.count(), 1, PatienceMs);
        QCOMPARE(done[0][1].toString(), QStringLiteral("finished"));
        QCOMPARE(QImage(mFolder.filePath(QStringLiteral("a.0001.png"))).size(), QSize(Side, Side));
    }

    void elsewhereTheJobFailsWithOneSentence_data()
    {
        QTest::addColumn<QString>("output");
        QTest::addColumn<QString>("what");
        QTest::newRow("a folder that is not there")
            << mFolder.filePath(QStringLiteral("mine/a.%04d.png"))
            << QStringLiteral("The computer that renders does not see the folder ");
        // This name means another folder for each process.
        QTest::newRow("another folder of the same name")
            << QStringLiteral("/proc/self/cwd/a.%04d.png")
            << QStringLiteral("The lit pictures are on the other computer, and not here.");
    }

    void elsewhereTheJobFailsWithOneSentence()
    {
        QFETCH(QString, output);
        QFETCH(QString, what);
        const QTemporaryDir here;
        const QString before = QDir::currentPath();
        QVERIFY(QDir::setCurrent(here.path()));
        const auto session = open(key("studio.key"), key("ana.key_secret"));
        light(*session);
        const QSignalSpy done(session.get(), &Worker::renderDone);
        const QSignalSpy frames(session.get(), &Worker::renderFrameDone);
        session->render(QStringLiteral("1"), output, Quality::Low);
        QTRY_COMPARE_WITH_TIMEOUT(done.count(), 1, PatienceMs);
        QDir::setCurrent(before);
        QCOMPARE(done[0][1].toString(), QStringLiteral("failed"));
        QCOMPARE(frames.count(), 0);
        QCOMPARE(mProblems.size(), 1);
        QVERIFY2(mProblems[0].what.startsWith(what), qPrintable(mProblems[0].what));
        QVERIFY(!QDir(mFolder.filePath(QStringLiteral("mine"))).exists());
    }

    void thisComputerCanWorkAgain()
    {
        const auto session = open(key("studio.key"), key("ana.key_secret"));
        light(*session);
        QTRY_VERIFY_WITH_TIMEOUT(session->isCurrent(mImage), PatienceMs);
        session->setComputer(std::nullopt); // its interpreter is none
        QTRY_COMPARE(mProblems.size(), 1);
        QCOMPARE(mProblems[0].kind, UserError::Kind::NoWorker);
        session->setComputer(computer(key("studio.key"), key("ana.key_secret"), mPort));
        session->start();
        mImage = {};
        QTRY_VERIFY_WITH_TIMEOUT(session->isCurrent(mImage), PatienceMs);
    }

    void cleanupTestCase() { stop(); }

private:
    QString keys() const { return mFolder.filePath(QStringLiteral("keys")); }
    QString key(const QString& name) const { return QDir(keys()).filePath(name); }
    QString key(const char* name) const { return key(QString::fromLatin1(name)); }

    static QStringList lampblack(const QStringList& words)
    {
        return QStringList{QStringLiteral("-I"), QStringLiteral("-m"), QStringLiteral("lampblack")} + words;
    }

    static void run(const QStringList& words)
    {
        QProcess process;
        process.start(qEnvironmentVariable("LAMPBLACK_PYTHON"), lampblack(words));
        QVERIFY(process.waitForFinished());
        QVERIFY2(process.exitCode() == 0, process.readAllStandardError().constData());
    }

    static Computer computer(const QString& worker, const QString& own, quint16 port)
    {
        return {QStringLiteral("127.0.0.1:%1").arg(port), worker, own};
    }

    void serve()
    {
        mServer = std::make_unique<QProcess>();
        mServer->setProcessChannelMode(QProcess::ForwardedChannels);
        mServer->setWorkingDirectory(mFolder.path());
        mServer->start(qEnvironmentVariable("LAMPBLACK_PYTHON"),
                       lampblack({QStringLiteral("serve"), QStringLiteral("--listen"),
                                  QStringLiteral("127.0.0.1:%1").arg(mPort), QStringLiteral("--key"),
                                  key("studio.key_secret"), QStringLiteral("--admit"), key("admitted")}));
        const auto listens = [this]
        {
            QTcpSocket socket;
            socket.connectToHost(QHostAddress(QHostAddress::LocalHost), mPort);
            return socket.waitForConnected(100);
        };
        QTRY_VERIFY_WITH_TIMEOUT(listens(), PatienceMs);
    }

    void stop()
    {
        if (mServer == nullptr)
        {
            return;
        }
        mServer->terminate();
        QVERIFY(mServer->waitForFinished());
    }

    std::unique_ptr<WorkerSession> open(const QString& worker, const QString& own, quint16 port = 0)
    {
        const Interpreter none{QStringLiteral("/nowhere/python"), QStringLiteral("the test")};
        auto session = std::make_unique<WorkerSession>(none);
        connect(session.get(), &Worker::imageArrived, this,
                [this](const PreviewImage& image) { mImage = image; });
        connect(session.get(), &Worker::problem, this,
                [this](const UserError& error) { mProblems.append(error); });
        session->setComputer(computer(worker, own, port == 0 ? mPort : port));
        session->start();
        return session;
    }

    static void light(WorkerSession& session)
    {
        session.putFrame(1, ball());
        session.setScene(defaultScene(QSize(Side, Side)));
        session.requestPreview(1, Show::Lit, QRectF(0, 0, Side, Side), QSize(Side, Side));
    }

    QTemporaryDir mFolder;
    std::unique_ptr<QProcess> mServer;
    quint16 mPort = 0;
    PreviewImage mImage;
    QVector<UserError> mProblems;
};

QTEST_GUILESS_MAIN(TestOtherComputer)
#include "test_other_computer.moc"
