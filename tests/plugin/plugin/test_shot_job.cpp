// "Render All Frames", from the frames of the host to the result layer.
#include "plugin/backup.h"
#include "plugin/project_scene.h"
#include "plugin/shot_job.h"
#include "support/fake_host.h"
#include "support/fake_worker.h"

#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>
#include <QTemporaryDir>

using namespace lampblack;

namespace
{

const QString Character = QStringLiteral("Line");

/// A project of eight frames whose drawings are exported at once.
struct Shot
{
    Shot()
    {
        host.mProject = folder.filePath(QStringLiteral("walk.pclx"));
        host.mDraw = [this](int frame, const QStringList&)
        {
            return broken.contains(frame) ? QImage() : QImage(4, 4, QImage::Format_RGBA8888);
        };
        QFile project(host.mProject);
        if (project.open(QFile::WriteOnly))
            project.write("as it was");
        document.reset(defaultScene(QSize(400, 300)));
        host.mModified = true;
    }

    QTemporaryDir folder;
    QVector<int> broken; ///< frames that cannot be exported
    FakeHost host;
    FakeWorker worker;
    SceneDocument document;
    FrameFeed feed{host, worker, document};
    LitLayer layer{host, document};
    ShotJob job{host, worker, feed, layer, document};
    QSignalSpy ended{&job, &ShotJob::finished};
    QSignalSpy problem{&job, &ShotJob::problem};
};

} // namespace

class ShotJobTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void framesBecomeTheLayer()
    {
        Shot shot;
        shot.job.render({1, 8}, {true});
        QCOMPARE(shot.worker.mFrames, QStringLiteral("1-8"));
        shot.worker.finishFrames({1, 2, 3, 4, 5, 6, 7, 8});
        shot.worker.endJob();
        QTRY_COMPARE(shot.ended.size(), 1);
        QVERIFY(shot.problem.isEmpty());
        QCOMPARE(shot.host.mDelivered.keys(), QList<int>({1, 2, 3, 4, 5, 6, 7, 8}));
        QVERIFY(QFileInfo(shot.host.mDelivered.value(8)).isFile());
        QVERIFY(shot.layer.isUnsaved() && shot.layer.exists());
        for (const Layer& layer : shot.host.mLayers)
            QCOMPARE(layer.visible, layer.name == QLatin1String("Lit") || layer.kind == Layer::Kind::Camera);

        // Hidden behind it, the sources are lit still, and the layer itself is not.
        QCOMPARE(shot.feed.litLayers(), QStringList({Character, QStringLiteral("Hills")}));
        QFile backup(shot.folder.filePath(QStringLiteral("walk.backup.pclx")));
        QVERIFY(backup.open(QFile::ReadOnly));
        QCOMPARE(backup.readAll(), QByteArray("as it was"));
    }

    void savedProjectIsRenderedFromItsFile()
    {
        Shot shot;
        Q_EMIT shot.host.projectOpened(shot.host.mProject);
        Q_EMIT shot.host.layersChanged();
        shot.host.mModified = false;
        shot.job.render({1, 8}, {true});
        QCOMPARE(shot.worker.mProject, shot.host.mProject);
        QCOMPARE(shot.worker.mFrames, QStringLiteral("1-8"));
        QVERIFY(shot.worker.mPut.isEmpty());
        shot.worker.finishFrames({1, 2, 3, 4, 5, 6, 7, 8});
        shot.worker.endJob();
        QTRY_COMPARE(shot.ended.size(), 1);
        QCOMPARE(shot.host.mDelivered.size(), 8);

        // The result layer, and the sources that are hidden behind it, are no change to what is lit.
        shot.job.render({1, 8}, {true});
        QCOMPARE(shot.worker.mProject, shot.host.mProject);
    }

    void unsavedDrawingsAreRenderedAsTheyAre()
    {
        Shot shot;
        Q_EMIT shot.host.layersChanged();
        shot.job.render({1, 8}, {false});
        QVERIFY(shot.worker.mProject.isEmpty());
        QCOMPARE(shot.worker.mPut.size(), 8);
        shot.job.cancel();

        // Pencil2D does not call a deleted or hidden layer a change.
        shot.host.mModified = false;
        shot.host.mLayers.last().visible = false;
        Q_EMIT shot.host.layersChanged();
        shot.job.render({1, 8}, {false});
        QVERIFY(shot.worker.mProject.isEmpty());
        shot.job.cancel();
        Q_EMIT shot.host.projectSaved(shot.host.mProject);
        shot.job.render({1, 8}, {false});
        QCOMPARE(shot.worker.mProject, shot.host.mProject);
    }

    void partJoinsWhatIsThere()
    {
        Shot shot;
        shot.job.render({1, 8}, {false});
        shot.worker.finishFrames({1, 2, 3, 4, 5, 6, 7, 8});
        shot.worker.endJob();
        QTRY_COMPARE(shot.ended.size(), 1);
        shot.job.render({3, 3}, {true});
        QCOMPARE(shot.worker.mFrames, QStringLiteral("3"));
        shot.worker.finishFrames({3});
        shot.worker.endJob();
        QTRY_COMPARE(shot.ended.size(), 2);
        QCOMPARE(shot.host.mDelivered.size(), 8);
    }

    void partAloneHidesNothing()
    {
        Shot shot;
        shot.job.render({3, 4}, {true});
        shot.worker.finishFrames({3, 4});
        shot.worker.endJob();
        QTRY_COMPARE(shot.ended.size(), 1);
        QCOMPARE(shot.host.mDelivered.keys(), QList<int>({3, 4}));
        for (const Layer& layer : shot.host.mLayers)
            QVERIFY(layer.visible);
    }

    void cancelledJobGoesOn()
    {
        Shot shot;
        shot.job.render({1, 8}, {false});
        shot.worker.finishFrames({1, 2, 3});
        shot.job.cancel();
        QCOMPARE(shot.worker.mCancelled, 1);
        QVERIFY(shot.host.mDelivered.isEmpty());
        Q_EMIT shot.host.drawingChanged(2);
        shot.job.render({1, 8}, {false});
        QCOMPARE(shot.worker.mFrames, QStringLiteral("2,4-8"));
        shot.worker.finishFrames({4});
        shot.job.cancel();

        Scene scene = shot.document.scene();
        scene.reliefScale = 0.5;
        shot.document.edit(QStringLiteral("Flatten"), scene);
        shot.job.render({1, 8}, {false});
        QCOMPARE(shot.worker.mFrames, QStringLiteral("1-8"));
    }

    void frameDrawnUponMeanwhileIsMadeAgain()
    {
        Shot shot;
        shot.job.render({1, 4}, {false});
        Q_EMIT shot.host.drawingChanged(2);
        shot.worker.finishFrames({1, 2});
        shot.job.cancel();
        shot.job.render({1, 4}, {false});
        QCOMPARE(shot.worker.mFrames, QStringLiteral("2-4"));
    }

    void missingFramesAreNamed()
    {
        Shot shot;
        shot.broken = {5};
        shot.job.render({1, 6}, {false});
        Q_EMIT shot.worker.problem({QStringLiteral("No light."), {}, QStringLiteral("frame 2")});
        shot.worker.finishFrames({1, 3, 4, 6});
        shot.worker.endJob();
        QTRY_COMPARE(shot.ended.size(), 1);
        QCOMPARE(shot.problem.size(), 1);
        const auto error = shot.problem.first().first().value<UserError>();
        QVERIFY(error.what.contains(QLatin1String("2 of 6")) && error.what.contains(QLatin1String("2,5")));
        QVERIFY(error.details.contains(QLatin1String("Frame 5 is broken.")));
        QVERIFY(error.details.contains(QLatin1String("frame 2")));
        QCOMPARE(shot.host.mDelivered.keys(), QList<int>({1, 3, 4, 6}));
    }

    void foreignLayerOfTheNameStays()
    {
        Shot shot;
        shot.host.mLayers.append({QStringLiteral("Lit"), Layer::Kind::Bitmap, true});
        shot.job.render({1, 2}, {false});
        shot.worker.finishFrames({1, 2});
        shot.worker.endJob();
        QTRY_COMPARE(shot.ended.size(), 1);
        QCOMPARE(shot.problem.size(), 1);
        QVERIFY(shot.host.mDelivered.isEmpty());
    }

    void noBackupNoLayer()
    {
        Shot shot;
        QVERIFY(QDir().mkpath(backupPath(shot.host.mProject) + QStringLiteral("/in the way")));
        shot.job.render({1, 2}, {false});
        shot.worker.finishFrames({1, 2});
        shot.worker.endJob();
        QTRY_COMPARE(shot.ended.size(), 1);
        QCOMPARE(shot.problem.size(), 1);
        QVERIFY(shot.host.mDelivered.isEmpty());
    }

    void projectOpenedMeanwhileIsLeftAlone()
    {
        Shot shot;
        shot.job.render({1, 2}, {false});
        shot.worker.finishFrames({1, 2});
        shot.worker.endJob();
        shot.host.mProject = shot.folder.filePath(QStringLiteral("other.pclx"));
        Q_EMIT shot.host.projectOpened(shot.host.mProject);
        QCOMPARE(shot.ended.size(), 1);
        QTest::qWait(100);
        QVERIFY(shot.host.mDelivered.isEmpty());
        QVERIFY(!shot.layer.isUnsaved());
    }

    void oldProjectIsBackedUpWithItsData()
    {
        const QTemporaryDir folder;
        const QString project = folder.filePath(QStringLiteral("walk.pcl"));
        QVERIFY(QDir().mkpath(project + QStringLiteral(".data")));
        for (const QString& path : {project, project + QStringLiteral(".data/001.001.png")})
        {
            QFile file(path);
            QVERIFY(file.open(QFile::WriteOnly));
        }
        QCOMPARE(backUpProject(project), QString());
        QVERIFY(QFile::exists(folder.filePath(QStringLiteral("walk.backup.pcl"))));
        QVERIFY(QFile::exists(folder.filePath(QStringLiteral("walk.backup.pcl.data/001.001.png"))));
    }

    void closingAsksForTheLayer()
    {
        Shot shot;
        const ProjectScene project(shot.host, shot.document, shot.layer);
        shot.host.mWindow.show();
        shot.job.render({1, 8}, {false});
        shot.worker.finishFrames({1, 2, 3, 4, 5, 6, 7, 8});
        shot.worker.endJob();
        QTRY_COMPARE(shot.ended.size(), 1);
        shot.host.mModified = false; // Pencil2D does not count the new layer
        for (const auto answer : {QMessageBox::Cancel, QMessageBox::Save})
        {
            QString question;
            QTimer::singleShot(0, &shot.host,
                               [&]
                               {
                                   auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
                                   QVERIFY(box != nullptr);
                                   question = box->text();
                                   box->button(answer)->click();
                               });
            QCOMPARE(shot.host.mWindow.close(), answer == QMessageBox::Save);
            QVERIFY(question.contains(QLatin1String("layer")));
        }
        QCOMPARE(shot.host.mSaved, 1);
    }
};

QTEST_MAIN(ShotJobTest)
#include "test_shot_job.moc"
